/* The core of the material (shading/base_bsdf.h) seen from one wo. */
#ifndef TRIAD_SHADING_BASE_MAKE_H
#define TRIAD_SHADING_BASE_MAKE_H

#include "shading/base_film.h"

#if TRIAD_SPECULAR
/* What the dielectric reflects at normal incidence. */
TRIAD_FUNCTION Colour base_coat0(const BsdfInput* in, float f0) {
    return colour_scale(colour_at_most(colour_scale(in->specular_colour, f0), colour_splat(1.0f)),
                        in->specular);
}
#if BSDF_TRANSMISSION
/* What base_interface_fresnel() needs. */
TRIAD_FUNCTION void base_interface(BaseBsdf* b, const BsdfInput* in, float f0) {
    const Colour specular = colour_splat(in->specular);
    b->eta = in->solid && in->inside ? 1.0f / in->ior : in->ior;
    b->specular = in->specular;
    b->dip = colour_scale(colour_sub(specular, base_coat0(in, f0)), 1.0f / (1.0f - f0));
}
#endif
/* The microfacets of the core and what lies over them. Returns the transmitter's share. */
TRIAD_FUNCTION float base_microfacets(BaseBsdf* b, const BsdfInput* in, Vec3 wo, float f0) {
    b->alpha = math_square(in->roughness);
    b->smooth = b->alpha < BSDF_SMOOTH_ALPHA;
#if BSDF_STRETCHED
    b->alpha_x = fma(1.0f - b->alpha, math_square(in->anisotropy), b->alpha);
    if (b->smooth && b->alpha_x >= BSDF_SMOOTH_ALPHA) b->smooth = 0u, b->alpha = BSDF_SMOOTH_ALPHA;
#endif
    b->stretch = base_stretch(b, wo);
#if BSDF_TRANSMISSION
    const float transmitter = in->ior >= 1.0f && f0 < 1.0f ? (1.0f - in->metallic) * in->transmission : 0.0f;
    b->transmits = transmitter > 0.0f;
    b->solid = in->solid;
    if (b->transmits && in->solid && in->ior < 1.0f + BSDF_SAME_INDEX) b->smooth = 1u;
#else
    const float transmitter = 0.0f;
    (void)f0;
#endif
#if BSDF_FILM
    b->film = colour_splat(0.0f);
    b->film_share = in->film_input.thickness > 0.0f ? in->film : 0.0f;
    if (b->film_share > 0.0f) {
        b->film_input = in->film_input;
        const Colour coat0 = base_coat0(in, f0);
        b->film0 = colour_fma_scale(in->metallic, colour_sub(in->base_colour, coat0), coat0);
#if BSDF_TRANSMISSION
        if (b->transmits) base_interface(b, in, f0);
#endif
    }
#endif
    return transmitter;
}
#endif

#if BSDF_FILM
/* Of the lobe that a film covers: 0 of a body that is nothing else. */
TRIAD_FUNCTION float base_film_weight(const BsdfInput* in, float opaque) {
    return fma(opaque, in->specular, in->metallic);
}
/* What base_make() can be given; 0 where it needs none. wo.z > 0. */
TRIAD_FUNCTION FilmMeans base_film_means(const BsdfInput* in, Vec3 wo) {
    BaseBsdf b;
    FilmMeans means;
    const float f0 = fresnel_normal(in->ior);
    const float transmitter = base_microfacets(&b, in, wo, f0);
    means.mean = means.rise = colour_splat(0.0f);
    if (!(b.film_share > 0.0f)) return means;
    if (base_film_weight(in, 1.0f - in->metallic - transmitter) > 0.0f) means.mean = base_film_mean(&b, wo);
#if BSDF_TRANSMISSION
    if (b.transmits && b.solid && !b.smooth) means.rise = base_film_rise(&b, wo);
#endif
    return means;
}
/* The film's share of what the microfacets reflect, `mean` of it, in a lobe of this weight; `kept` is the
 * albedo of the rough base with Fresnel factor 1, coat_albedo of what covers the Lambert lobe. Returns the
 * albedo of that share. */
TRIAD_FUNCTION float base_add_film(BaseBsdf* b, const BsdfInput* in, Colour mean, float weight, float kept,
                                   Colour* coat_albedo) {
    Colour whole = colour_fma_scale((1.0f - kept) / kept, mean, colour_splat(1.0f));
    Colour film_albedo = colour_scale(colour_mul(whole, mean), in->film * kept);
    b->film = colour_scale(whole, in->film * weight);
    b->specular0 = colour_scale(b->specular0, 1.0f - in->film);
    b->specular1 = colour_scale(b->specular1, 1.0f - in->film);
    const Colour hidden = colour_add(film_albedo, colour_splat(b->smooth ? 0.0f : in->film * FILM_LOSS));
    *coat_albedo = colour_fma_scale(in->specular, hidden, colour_scale(*coat_albedo, 1.0f - in->film));
    return colour_average(film_albedo) * weight;
}
#endif

/* The Lambert base, of which `share` is seen. */
TRIAD_FUNCTION void base_lambert(BaseBsdf* b, const BsdfInput* in, float share) {
    b->diffuse = colour_scale(in->base_colour, share);
#if TRIAD_DIFFUSE_TRANSMISSION
    b->diffuse_through = colour_splat(0.0f);
    b->p_through = 0.0f;
    if (in->through > 0.0f) {
        b->diffuse = colour_scale(b->diffuse, 1.0f - in->through);
        b->diffuse_through = colour_scale(in->through_colour, share * in->through);
        float through = colour_average(b->diffuse_through), albedo = colour_average(b->diffuse) + through;
        b->p_through = albedo > 0.0f ? through / albedo : 0.0f;
    }
#endif
}
TRIAD_FUNCTION float base_lambert_albedo(const BaseBsdf* b) {
    float albedo = colour_average(b->diffuse);
#if TRIAD_DIFFUSE_TRANSMISSION
    albedo += colour_average(b->diffuse_through);
#endif
    return albedo;
}

#if BSDF_TRANSMISSION
/* The transmitter's share of the core, whose `reflected` is the albedo of GGX with Fresnel factor 1. Returns
 * an estimate of its albedo, without a film.
 */
TRIAD_FUNCTION float base_add_transmitter(BaseBsdf* b, const BsdfInput* in, Vec3 wo, float transmitter,
                                          float f0, float reflected, global const float* albedo_tables) {
    b->tint = in->base_colour;
    base_interface(b, in, f0);
    b->transmitter = colour_splat(transmitter);
    if (!b->smooth) {
        Colour kept = colour_splat(reflected);
        if (in->solid) {
            Vec2 glass = albedo_glass(albedo_tables, wo.z, in->roughness, f0, in->inside);
            const float bare = fma(in->specular, reflected, (1.0f - in->specular) * glass.y);
            kept = colour_fma_scale(glass.x - reflected, b->dip, colour_splat(bare));
#if BSDF_FILM
            if (b->film_share > 0.0f) {
                const Colour rise =
                    in->has_film_means ? colour_load(in->film_means, 1u) : base_film_rise(b, wo);
                kept = colour_fma_scale(b->film_share, rise, kept);
                const float loss = in->inside ? FILM_INSIDE_LOSS : FILM_BODY_LOSS;
                kept = colour_scale(kept, fma(b->film_share, loss, 1.0f));
            }
#endif
        }
        b->transmitter = colour_div(colour_splat(transmitter), kept);
        /* Inside a rough body most normals reflect totally, and many of them into the surface. Samples
         * that end there make the others heavy, bounce after bounce: the cap leaves most of them out. */
        if (in->solid && in->inside) b->p_cap = math_saturate(1.0f - colour_average(kept));
    }
    Colour film = colour_splat(0.0f);
#if BSDF_FILM
    if (b->film_share > 0.0f) film = base_film(b, wo.z);
#endif
    Colour f = base_transmitter_fresnel(b, wo.z, film);
    Colour seen = colour_add(f, colour_mul(colour_complement(f), b->tint));
    return transmitter * math_max(colour_average(seen), BSDF_MIN_TRANSMITTER);
}
#endif

/* wo.z > 0. Colours in [0, 1], metallic, roughness, specular, transmission in [0, 1], ior 0 or at least 1. */
TRIAD_FUNCTION BaseBsdf base_make(const BsdfInput* in, Vec3 wo, global const float* albedo_tables) {
    BaseBsdf b;
#if !TRIAD_SPECULAR
    (void)wo, (void)albedo_tables;
    base_lambert(&b, in, 1.0f);
#if BSDF_LAYERED
    b.albedo = base_lambert_albedo(&b);
#endif
#else
    const float f0 = fresnel_normal(in->ior);
    const Colour coat0 = base_coat0(in, f0);
    const float transmitter = base_microfacets(&b, in, wo, f0);
    const float opaque = 1.0f - in->metallic - transmitter;
    if (in->metallic == 0.0f && in->specular == 0.0f && transmitter == 0.0f) {
        b.specular0 = b.specular1 = colour_splat(0.0f); /* what follows would come to the same bits */
        b.p_specular = 0.0f;
        base_lambert(&b, in, opaque);
#if BSDF_LAYERED
        b.albedo = base_lambert_albedo(&b);
#endif
        return b;
    }
    /* directional albedo of GGX reflection, Fresnel factor 1 and (1 - cos)^5 */
    Vec2 albedo = vec2_make(1.0f, fresnel_schlick_weight(wo.z));
    if (!b.smooth) albedo = albedo_ggx(albedo_tables, wo.z, in->roughness);
#if BSDF_STRETCHED
    if (!b.smooth && b.alpha_x != b.alpha)
        albedo = albedo_stretched(albedo_tables, wo, sqrt(b.alpha), in->anisotropy);
#endif
    float missing = (1.0f - albedo.x) / albedo.x; /* Turquin 2019: f = f_single (1 + F0 (1 - E) / E) */

    Colour metal0 = in->base_colour;
    Colour metal = colour_scale(colour_fma_scale(missing, metal0, colour_splat(1.0f)), in->metallic);
    Colour coat = colour_fma_scale(missing, coat0, colour_splat(1.0f));
    Colour opaque_coat = colour_scale(coat, opaque),
           coat_rise = colour_sub(colour_splat(in->specular), coat0);
    b.specular0 = colour_fma(metal, metal0, colour_mul(opaque_coat, coat0));
    b.specular1 = colour_fma(metal, colour_complement(metal0), colour_mul(opaque_coat, coat_rise));
    Colour coat_albedo =
        colour_mul(coat, colour_fma_scale(albedo.y, coat_rise, colour_scale(coat0, albedo.x)));
    float p = 0.0f;
#if BSDF_FILM
    if (b.film_share > 0.0f) {
        const float weight = base_film_weight(in, opaque);
        Colour mean = colour_splat(0.0f);
        if (weight > 0.0f)
            mean = in->has_film_means ? colour_load(in->film_means, 0u) : base_film_mean(&b, wo);
        p = base_add_film(&b, in, mean, weight, albedo.x, &coat_albedo);
    }
#endif
    base_lambert(&b, in, opaque * math_max(0.0f, 1.0f - colour_largest(coat_albedo)));
    p += colour_average(colour_fma_scale(albedo.y, b.specular1, colour_scale(b.specular0, albedo.x)));
    uint bounded = !b.smooth;
#if BSDF_TRANSMISSION
    b.p_cap = 0.0f;
    if (b.transmits) {
        p += base_add_transmitter(&b, in, wo, transmitter, f0, albedo.x, albedo_tables);
        bounded = b.p_cap > 0.0f;
    }
#endif
    b.cap = bounded ? ggx_cap(wo, b.alpha) : 1.0f;
    float d = base_lambert_albedo(&b);
#if BSDF_LAYERED
    b.albedo = p + d;
#endif
    b.p_specular = p > 0.0f ? (d > 0.0f ? p / (p + d) : 1.0f) : 0.0f;
#endif
    return b;
}

#endif
