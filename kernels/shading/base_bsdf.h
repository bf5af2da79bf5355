/* The core of the glTF material: mix(dielectric, metal), where a dielectric is a coated diffuse base or, by
 * `transmission`, a thin wall or the boundary of a solid body. Its microfacets may be stretched (anisotropy)
 * or covered by a thin film (iridescence), and a share of the diffuse base may leave on the other side.
 * Formulas, sources and what is not reciprocal: docs/shading.md. Conventions: shading/bsdf.h.
 */
#ifndef TRIAD_SHADING_BASE_BSDF_H
#define TRIAD_SHADING_BASE_BSDF_H

#include "shading/albedo.h"
#include "shading/bsdf_input.h"
#include "shading/ggx.h"
#include "shading/thin_film.h"

#if BSDF_FILM
/* Of the visible normals whose (wo.h)^2 lies in a bin or beyond: their share, as they are seen, and the sum
 * of (wo.h)^2 (shading/base_film.h). */
#define FILM_BINS 12u
typedef struct FilmBins {
    float share[FILM_BINS], square[FILM_BINS];
} FilmBins;
#endif

/* A material seen from one wo. */
typedef struct BaseBsdf {
    Colour diffuse; /* albedo of the Lambert lobe */
#if TRIAD_DIFFUSE_TRANSMISSION
    Colour diffuse_through; /* the same beyond the surface */
    float p_through;        /* probability of the Lambert lobe beyond, when one of the two is sampled */
#endif
#if BSDF_LAYERED
    float albedo; /* estimate of all that is reflected and transmitted: how often it is sampled */
#endif
#if TRIAD_SPECULAR
    Colour specular0, specular1; /* reflection of metal and coat: specular0 + specular1 (1 - wo.h)^5 */
    float alpha;
#if BSDF_STRETCHED
    float alpha_x; /* along x; alpha: along y */
#endif
#if BSDF_FILM
    Colour film;  /* share of the film times its weight, 0: none */
    Colour film0; /* reflectance of the base under the film at normal incidence */
    FilmInput film_input;
    float film_share;   /* 0: there is none */
    FilmBins film_bins; /* while this is made: here, for private memory is shared by what lives as long */
#endif
    float stretch;    /* ggx_stretch of wo */
    float cap;        /* ggx_cap of wo; 1: normals are not bounded */
    float p_specular; /* probability of sampling the microfacets and not the Lambert lobe */
    uint smooth;      /* the microfacets are one mirror: delta lobes */
#endif
#if BSDF_TRANSMISSION
    uint transmits;
    uint solid;
    float eta;      /* index beyond the surface over index before it */
    float specular; /* F of the transmitter = specular - dip (1 - F of the bare interface) */
    Colour dip;
    Colour transmitter; /* its weight, energy compensation included */
    Colour tint;
    float p_cap; /* of a transmitter: probability that the normal is drawn within the cap */
#endif
} BaseBsdf;

#if BSDF_FILM
/* The film's reflectance, c the cosine on wo's side: that of outside, for a reflection has no side. */
TRIAD_FUNCTION Colour base_film(const BaseBsdf* b, float c) {
#if BSDF_TRANSMISSION
    if (b->transmits && b->eta < 1.0f) c = fresnel_refracted_cosine(c, b->eta);
#endif
    return film_reflectance(&b->film_input, b->film0, c);
}
#endif

#if BSDF_TRANSMISSION
/* Of radiance that crosses. */
TRIAD_FUNCTION float base_body_scale(const BaseBsdf* b) { return b->solid ? 1.0f / (b->eta * b->eta) : 1.0f; }
/* One interface without a film, whose dielectric of this index reflects r. */
TRIAD_FUNCTION Colour base_interface_fresnel(const BaseBsdf* b, float r) {
    /* Brewster's dip goes below normal incidence */
    return colour_at_least(colour_fma_scale(r - 1.0f, b->dip, colour_splat(b->specular)), colour_splat(0.0f));
}
/* Fresnel factor of the transmitting part, c the cosine on wo's side; film: base_film of it, where there is
 * one. */
TRIAD_FUNCTION Colour base_transmitter_fresnel(const BaseBsdf* b, float c, Colour film) {
    float r = fresnel_dielectric(c, b->eta);
    if (r >= 1.0f) return colour_splat(1.0f);
    Colour f = base_interface_fresnel(b, r);
#if BSDF_FILM
    f = colour_fma_scale(b->film_share, colour_sub(film, f), f);
#else
    (void)film;
#endif
    /* both faces of a thin wall and all reflections between them: R = 2F / (1 + F), T = (1 - F) / (1 + F) */
    return b->solid ? f : colour_div(colour_scale(f, 2.0f), colour_add(colour_splat(1.0f), f));
}
#endif

#if TRIAD_SPECULAR
/* What a microfacet reflects and lets through (change of radiance not included) at wo.h = c. */
TRIAD_FUNCTION void base_microfacet(const BaseBsdf* b, float c, Colour* reflected, Colour* transmitted) {
    Colour film = colour_splat(0.0f);
    *reflected = colour_fma_scale(fresnel_schlick_weight(c), b->specular1, b->specular0);
#if BSDF_FILM
    if (b->film_share > 0.0f) {
        film = base_film(b, c);
        *reflected = colour_fma(b->film, film, *reflected);
    }
#endif
    *transmitted = colour_splat(0.0f);
#if BSDF_TRANSMISSION
    if (b->transmits) {
        Colour f = base_transmitter_fresnel(b, c, film);
        *reflected = colour_add(*reflected, colour_mul(b->transmitter, f));
        *transmitted = colour_mul(colour_mul(b->transmitter, b->tint), colour_complement(f));
    }
#else
    (void)film;
#endif
}

/* Probability of choosing reflection at such a microfacet; negative when it is black. */
TRIAD_FUNCTION float base_reflect_probability(const BaseBsdf* b, Colour reflected, Colour transmitted) {
#if BSDF_TRANSMISSION
    if (b->transmits) {
        float r = colour_average(reflected), t = colour_average(transmitted);
        return r + t > 0.0f ? r / (r + t) : -1.0f;
    }
#else
    (void)b, (void)reflected, (void)transmitted;
#endif
    return 1.0f;
}
#endif

#if TRIAD_SPECULAR
/* ggx_distribution and ggx_stretch of the base. */
TRIAD_FUNCTION float base_distribution(const BaseBsdf* b, Vec3 h) {
#if BSDF_STRETCHED
    if (b->alpha_x != b->alpha) return ggx_distribution_xy(h, b->alpha_x, b->alpha);
#endif
    return ggx_distribution(h, b->alpha);
}
TRIAD_FUNCTION float base_stretch(const BaseBsdf* b, Vec3 w) {
#if BSDF_STRETCHED
    if (b->alpha_x != b->alpha) return ggx_stretch_xy(w, b->alpha_x, b->alpha);
#endif
    return ggx_stretch(w, b->alpha);
}
TRIAD_FUNCTION Vec3 base_normal(const BaseBsdf* b, Vec3 wo, float cap, Vec2 u) {
#if BSDF_STRETCHED
    return ggx_sample_xy(wo, b->alpha_x, b->alpha, b->stretch, cap, u);
#else
    return ggx_sample(wo, b->alpha, b->stretch, cap, u);
#endif
}
#endif

#endif
