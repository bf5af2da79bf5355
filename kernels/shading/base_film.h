/* What the microfacets of the core (shading/base_bsdf.h) reflect of a thin film in the mean: a sum over
 * visible normals, which share out their (wo.h)^2 to bins, in each of which the film is computed twice. */
#ifndef TRIAD_SHADING_BASE_FILM_H
#define TRIAD_SHADING_BASE_FILM_H

#include "shading/base_bsdf.h"

#if BSDF_FILM
#define FILM_NORMALS 64u
/* Half the extent of what a normal stands for, over the root of its solid angle. */
#define FILM_EXTENT 0.15f
/* From inside a film may be steeper than what normals find: more of them, that overlap. */
#define FILM_INSIDE_NORMALS 192u
#define FILM_INSIDE_EXTENT 0.35f
/* Where in a bin the film is computed: Gauss-Legendre of two points. */
#define FILM_NODE 0.21132487f
#define FILM_RANGE_NORMALS 32u
/* Normals at once: a loop that compilers vectorise, but where items are the lanes. */
#if TRIAD_INLINED
#define FILM_BLOCK 1u
#else
#define FILM_BLOCK 16u
#endif
#define FILM_LEAST_SHARE 1e-5f
/* What is lost for what the sums miss: by a Lambert lobe below a film on a rough base, and the share of the
 * albedo by a rough body, from outside and from inside. */
#define FILM_LOSS 0.002f
#define FILM_BODY_LOSS 0.0007f
#define FILM_INSIDE_LOSS 0.0025f

/* Visible normal k of 1 / step; heights are even in their root, for the few that lean far reflect most:
 * weight. */
TRIAD_FUNCTION Vec3 base_film_normal(const BaseBsdf* b, Vec3 wo, uint k, float step, float* weight) {
    const float turn = ((float)k + 0.5f) * 0.618034f, t = ((float)k + 0.5f) * step;
    *weight = 2.0f * t * step;
    return base_normal(b, wo, 1.0f, vec2_make(turn - math_floor(turn), fma(-t, t, 1.0f)));
}
/* Share of what a visible normal scatters to w.z above the surface that is not masked: G2 / G1. */
TRIAD_FUNCTION float base_unmasked(const BaseBsdf* b, Vec3 wo, Vec3 w) {
    if (w.z <= 0.0f) return 0.0f;
    return 0.5f * (wo.z + b->stretch) * ggx_masking(wo.z, b->stretch, w.z, base_stretch(b, w));
}
/* What a visible normal reflects that is not masked; of a body less what it refracts that is not, or would
 * be. */
TRIAD_FUNCTION float base_film_seen(const BaseBsdf* b, Vec3 wo, Vec3 h, float c, float eta, uint body) {
    const float seen = base_unmasked(b, wo, vec3_reflect(wo, h));
    if (!body) return seen;
    const float k = c / eta - fresnel_refracted_cosine(c, eta);
    return seen - base_unmasked(b, wo, vec3_sub(vec3_scale(wo, 1.0f / eta), vec3_scale(h, k)));
}

/* (wo.h)^2 of visible normals, even between `least` and `most`; what is seen of them is that times `density`.
 */
typedef struct FilmBlock {
    float least[FILM_BLOCK], most[FILM_BLOCK], density[FILM_BLOCK];
} FilmBlock;
TRIAD_FUNCTION_PER_CALL void base_film_block(const BaseBsdf* b, Vec3 wo, float eta, uint body, uint first,
                                             float step, float extent, FilmBlock* block) {
    for (uint i = 0u; i < FILM_BLOCK; ++i) {
        float weight;
        const Vec3 h = base_film_normal(b, wo, first + i, step, &weight);
        const float c = math_min(vec3_dot(wo, h), 1.0f);
        const float solid_angle = weight / ggx_normal_pdf(base_distribution(b, h), c, wo.z, b->stretch);
        float half_extent = extent * math_sqrt((1.0f - c * c) * solid_angle);
        half_extent = math_min(half_extent, math_min(c, 1.0f - c)) + 1e-4f;
        block->least[i] = math_square(math_max(c - half_extent, 0.0f));
        block->most[i] = math_square(c + half_extent);
        block->density[i] =
            weight * base_film_seen(b, wo, h, c, eta, body) / (block->most[i] - block->least[i]);
    }
}

/* The bins: even in the fourth root of the cosine outside, from `first` on, for a film is steep along the
 * surface, and so from inside where total reflection begins; eta: index outside over inside, at most 1. */
typedef struct FilmRange {
    float eta, first, width;
} FilmRange;
/* That of the normals that are seen: a smooth base has few cosines. */
TRIAD_FUNCTION_PER_CALL FilmRange base_film_range(const BaseBsdf* b, Vec3 wo, float eta) {
    float least = 1.0f, most = 0.0f;
    for (uint k = 0u; k < FILM_RANGE_NORMALS; ++k) {
        float weight;
        const Vec3 h = base_film_normal(b, wo, k, 1.0f / FILM_RANGE_NORMALS, &weight);
        const float c = math_min(vec3_dot(wo, h), 1.0f);
        least = math_min(least, c);
        most = math_max(most, c);
    }
    if (eta < 1.0f) {
        least = fresnel_refracted_cosine(least, eta);
        most = fresnel_refracted_cosine(most, eta);
    }
    least = math_sqrt(math_sqrt(math_max(least, 0.0f)));
    most = math_sqrt(math_sqrt(math_max(most, 0.0f)));
    const float beyond = fma(most - least, 1.0f / FILM_RANGE_NORMALS, 1e-5f);
    FilmRange range;
    range.eta = eta;
    range.first = math_max(least - beyond, 0.0f);
    range.width = (math_min(most + beyond, 1.0f) - range.first) / FILM_BINS;
    return range;
}
/* The cosine outside at a place of the bins, and the square of that inside. */
TRIAD_FUNCTION float film_outside(const FilmRange* range, float place) {
    return math_square(math_square(fma(place, range->width, range->first)));
}
TRIAD_FUNCTION float film_square(const FilmRange* range, float place) {
    const float eta = range->eta, outside = film_outside(range, place);
    return fma(eta * eta, outside * outside, (1.0f - eta) * (1.0f + eta));
}

TRIAD_FUNCTION_PER_CALL void base_film_bins(const BaseBsdf* b, Vec3 wo, float eta, uint body,
                                            const FilmRange* range, FilmBins* bins) {
    const uint inside = eta < 1.0f, count = inside ? FILM_INSIDE_NORMALS : FILM_NORMALS;
    const float extent = inside ? FILM_INSIDE_EXTENT : FILM_EXTENT;
    for (uint i = 0u; i < FILM_BINS; ++i) bins->share[i] = bins->square[i] = 0.0f;
    FilmBlock block;
    for (uint k = 0u; k < count; k += FILM_BLOCK) {
        base_film_block(b, wo, eta, body, k, 1.0f / (float)count, extent, &block);
        for (uint j = 0u; j < FILM_BLOCK; ++j) {
            const float least = block.least[j], most = block.most[j], density = block.density[j];
            for (uint i = 0u; i < FILM_BINS; ++i) {
                /* what a body reflects totally it does with a film, too, and is not in the sum */
                const float from = i > 0u || body ? math_max(least, film_square(range, (float)i)) : least;
                const float share = density * math_max(most - from, 0.0f);
                bins->share[i] += share;
                bins->square[i] = fma(0.5f * share, from + most, bins->square[i]);
            }
        }
    }
}
/* Shares of the two places of a bin: those that have its share and its mean of (wo.h)^2. Terms may cancel. */
TRIAD_FUNCTION Vec2 film_bin_shares(const FilmBins* bins, const FilmRange* range, uint i) {
    const uint last = i + 1u == FILM_BINS;
    const float share = bins->share[i] - (last ? 0.0f : bins->share[i + 1u]);
    const float square = bins->square[i] - (last ? 0.0f : bins->square[i + 1u]);
    if (fabs(share) <= FILM_LEAST_SHARE) return vec2_splat(0.0f);
    const float least = i > 0u ? film_square(range, (float)i) : (1.0f - range->eta) * (1.0f + range->eta);
    const float most = last ? 1.0f : film_square(range, (float)i + 1.0f);
    const float mean = math_min(math_max(square / share, least), most);
    const float first = film_square(range, (float)i + FILM_NODE),
                second = film_square(range, (float)i + 1.0f - FILM_NODE);
    const float part = second > first ? share * (mean - first) / (second - first) : share;
    return vec2_make(share - part, part);
}

/* Over the visible normals, as they are seen: the film's reflectance, their share, and of a body the
 * reflectance of the bare dielectric. */
typedef struct FilmSum {
    Colour film;
    float seen, bare;
} FilmSum;
/* x, y, z: of wo, which would lie in memory as a struct; eta: that of the body, 1 of what reflects only. */
TRIAD_FUNCTION_ONCE FilmSum base_film_seen_by(BaseBsdf* b, float x, float y, float z, float eta, uint body) {
    const Vec3 wo = vec3_make(x, y, z);
    FilmRange range = {math_min(eta, 1.0f), 0.0f, 1.0f / FILM_BINS};
    if (!body) range = base_film_range(b, wo, range.eta);
    base_film_bins(b, wo, eta, body, &range, &b->film_bins);
    FilmSum sum;
    sum.film = colour_splat(0.0f);
    sum.seen = sum.bare = 0.0f;
    for (uint k = 0u; k < 2u * FILM_BINS; ++k) {
        const uint i = k >> 1, second = k & 1u;
        const Vec2 shares = film_bin_shares(&b->film_bins, &range, i);
        const float share = second ? shares.y : shares.x;
        if (share == 0.0f) continue;
        const float place = (float)i + (second ? 1.0f - FILM_NODE : FILM_NODE);
        const Colour film = film_reflectance(&b->film_input, b->film0, film_outside(&range, place));
        sum.film = colour_fma_scale(share, film, sum.film);
        sum.seen += share;
        if (body)
            sum.bare = fma(share, fresnel_dielectric(math_sqrt(film_square(&range, place)), eta), sum.bare);
    }
    return sum;
}
/* Mean of the film's reflectance over the reflections of the base, weighted as they are seen. */
TRIAD_FUNCTION Colour base_film_mean(BaseBsdf* b, Vec3 wo) {
    if (b->smooth) return base_film(b, wo.z);
    float eta = 1.0f;
#if BSDF_TRANSMISSION
    if (b->transmits) eta = math_min(b->eta, 1.0f);
#endif
    const FilmSum sum = base_film_seen_by(b, wo.x, wo.y, wo.z, eta, 0u);
    return sum.seen > 0.0f ? colour_scale(sum.film, 1.0f / sum.seen) : base_film(b, wo.z);
}
#if BSDF_TRANSMISSION
/* What a film of share 1 adds to the albedo of a rough body: it reflects more than the interface that the
 * table is of, and what is reflected is masked otherwise than what is refracted. */
TRIAD_FUNCTION Colour base_film_rise(BaseBsdf* b, Vec3 wo) {
    const FilmSum sum = base_film_seen_by(b, wo.x, wo.y, wo.z, b->eta, 1u);
    const Colour bare = colour_fma_scale(sum.bare - sum.seen, b->dip, colour_splat(b->specular * sum.seen));
    return colour_sub(sum.film, bare);
}
#endif
#endif

#endif
