/* The glTF material: a varnish (clearcoat) over fibres (sheen) over its core (shading/base_bsdf.h). A layer
 * lets through to what is below it what it does not reflect itself, by its albedo as seen from wo: no light
 * is made, and in a white furnace none is lost. Formulas, sources and what is not reciprocal:
 * docs/shading.md.
 *
 * Local frame: +z is the shading normal on wo's side (wo.z > 0); wi.z < 0 is beyond the surface. All
 * directions point away from the surface. f is the BSDF, values are f |cos wi|; pdfs are per solid angle.
 * Radiance crossing into a body of index n changes by 1 / n^2 per the way of the path (Walter et al. 2007),
 * and back on leaving it: bsdf_body_scale().
 */
#ifndef TRIAD_SHADING_BSDF_H
#define TRIAD_SHADING_BSDF_H

#include "shading/base_make.h"
#include "shading/base_sample.h"
#include "shading/clearcoat.h"
#include "shading/sheen.h"

/* A material seen from one wo. */
typedef struct Bsdf {
    BaseBsdf base;
#if BSDF_LAYERED
    float base_weight; /* what the layers let through */
    float p_base;      /* probability of sampling the base */
#endif
#if TRIAD_SHEEN
    SheenLobe sheen;
    float p_sheen;
#endif
#if TRIAD_CLEARCOAT
    CoatLobe coat;
    float sheen_weight; /* what the coat lets through */
    float p_coat;
#endif
} Bsdf;

/* wo.z > 0. Colours in [0, 1], metallic, roughness, specular, transmission, shares in [0, 1], ior 0 or at
 * least 1. */
TRIAD_FUNCTION Bsdf bsdf_make(const BsdfInput* in, Vec3 wo, global const float* albedo_tables) {
    Bsdf b;
    b.base = base_make(in, wo, albedo_tables);
#if BSDF_LAYERED
    float weight = 1.0f, above = 0.0f;
#if TRIAD_CLEARCOAT
    b.coat = coat_make(in, wo, albedo_tables);
    weight -= b.coat.albedo;
    b.sheen_weight = weight;
    b.p_coat = b.coat.albedo;
    above += b.p_coat;
#endif
#if TRIAD_SHEEN
    b.sheen = sheen_make(in, wo, albedo_tables);
    b.p_sheen = weight * colour_average(b.sheen.colour) * b.sheen.albedo;
    above += b.p_sheen;
    weight *= math_max(0.0f, 1.0f - colour_largest(b.sheen.colour) * b.sheen.albedo);
#endif
    b.base_weight = weight;
    b.p_base = 1.0f;
    if (above > 0.0f) {
        float inverse = 1.0f / fma(weight, b.base.albedo, above);
#if TRIAD_CLEARCOAT
        b.p_coat *= inverse;
#endif
#if TRIAD_SHEEN
        b.p_sheen *= inverse;
#endif
        b.p_base = math_max(0.0f, 1.0f - above * inverse);
    }
#endif
    return b;
}

/* Factor of radiance that crosses into, or out of, a solid body. */
TRIAD_FUNCTION float bsdf_body_scale(const Bsdf* b) {
#if BSDF_TRANSMISSION
    return base_body_scale(&b->base);
#else
    (void)b;
    return 1.0f;
#endif
}

/* Nonzero when the material is one mirror or clear boundary: delta lobes alone. */
TRIAD_FUNCTION uint bsdf_is_smooth(const Bsdf* b) {
#if TRIAD_SPECULAR
    return b->base.smooth;
#else
    (void)b;
    return 0u;
#endif
}

/* Nonzero when bsdf_eval can be: else there is no point in sampling lights. */
TRIAD_FUNCTION uint bsdf_has_smooth(const Bsdf* b) {
    uint lit = base_has_smooth(&b->base);
#if TRIAD_CLEARCOAT
    lit = lit || b->p_coat > 0.0f;
#endif
#if TRIAD_SHEEN
    lit = lit || b->p_sheen > 0.0f;
#endif
    return lit;
}

/* f |cos wi| and its pdf over all lobes; delta lobes excluded. */
TRIAD_FUNCTION Colour bsdf_eval(const Bsdf* b, Vec3 wo, Vec3 wi, float* pdf) {
    Colour f = base_eval(&b->base, wo, wi, pdf);
#if BSDF_LAYERED
    f = colour_scale(f, b->base_weight);
    *pdf *= b->p_base;
#endif
#if TRIAD_SHEEN
    if (b->p_sheen > 0.0f && wi.z > 0.0f) {
        float value = sheen_eval(&b->sheen, wo, wi);
#if TRIAD_CLEARCOAT
        value *= b->sheen_weight;
#endif
        f = colour_fma_scale(value, b->sheen.colour, f);
        *pdf = fma(b->p_sheen, 0.5f * MATH_INV_PI, *pdf);
    }
#endif
#if TRIAD_CLEARCOAT
    if (b->p_coat > 0.0f && wi.z > 0.0f) {
        float coat_pdf;
        f = colour_add(f, colour_splat(coat_eval(&b->coat, wo, wi, &coat_pdf)));
        *pdf = fma(b->p_coat, coat_pdf, *pdf);
    }
#endif
    return f;
}

/* One sample: `numbers` pick the lobe and the direction, u_through whether it goes through a boundary; all in
 * [0, 1). */
TRIAD_FUNCTION BsdfSample bsdf_sample(const Bsdf* b, Vec3 wo, float u_through, Vec2 numbers) {
#if !BSDF_LAYERED
    return base_sample(&b->base, wo, u_through, numbers);
#else
    Vec2 u = numbers;
    BsdfSample s;
    if (sampling_choose(&u.x, b->p_base)) {
        s = base_sample(&b->base, wo, u_through, u);
        if (b->p_base == 1.0f || s.event == BSDF_NONE) return s;
        if (s.event & BSDF_DELTA) {
            s.weight = colour_scale(s.weight, b->base_weight / b->p_base);
            return s;
        }
    } else {
        s.event = BSDF_GLOSSY;
        s.weight = colour_splat(0.0f);
        s.pdf = 0.0f;
#if TRIAD_CLEARCOAT && TRIAD_SHEEN
        const uint coat = !sampling_choose(&u.x, b->p_sheen / (1.0f - b->p_base));
#else
        const uint coat = TRIAD_CLEARCOAT;
#endif
#if TRIAD_CLEARCOAT
        if (coat) s.wi = coat_sample(&b->coat, wo, u);
#endif
#if TRIAD_SHEEN
        if (!coat) {
            s.wi = sampling_hemisphere(u);
            s.event = BSDF_DIFFUSE;
        }
#endif
        if (s.wi.z <= 0.0f) {
            s.event = BSDF_NONE;
            return s;
        }
    }
    bsdf_weigh(&s, bsdf_eval(b, wo, s.wi, &s.pdf));
    return s;
#endif
}

#endif
