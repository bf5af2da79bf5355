/* The core of the material (shading/base_bsdf.h): its value and density for two directions, and samples of
 * it. */
#ifndef TRIAD_SHADING_BASE_SAMPLE_H
#define TRIAD_SHADING_BASE_SAMPLE_H

#include "common/sampling.h"
#include "shading/base_bsdf.h"

#if BSDF_TRANSMISSION
/* Of the density of a transmitter's normals h, the factor that a cap changes: 1 / (z + s) without one. */
TRIAD_FUNCTION float base_cap_factor(const BaseBsdf* b, float z_o, uint in_cap) {
    float bounded = in_cap ? b->p_cap / fma(b->cap, z_o, b->stretch) : 0.0f;
    return bounded + (1.0f - b->p_cap) / (z_o + b->stretch);
}
#endif

/* Nonzero when base_eval can be: else there is no point in sampling lights. */
TRIAD_FUNCTION uint base_has_smooth(const BaseBsdf* b) {
    uint lit = colour_largest(b->diffuse) > 0.0f;
#if TRIAD_DIFFUSE_TRANSMISSION
    lit = lit || b->p_through > 0.0f;
#endif
#if TRIAD_SPECULAR
    lit = lit || (b->p_specular > 0.0f && !b->smooth);
#endif
    return lit;
}

#if TRIAD_SPECULAR
/* Adds the microfacets' f |cos| and pdf; wi.z != 0. */
TRIAD_FUNCTION void base_eval_microfacets(const BaseBsdf* b, Vec3 wo, Vec3 wi, Colour* f, float* pdf) {
    Colour reflected, transmitted;
#if BSDF_TRANSMISSION
    if (wi.z < 0.0f) {
        Vec3 w = b->solid ? wi : vec3_make(wi.x, wi.y, -wi.z);
        float eta = b->solid ? b->eta : 1.0f;
        Vec3 h = vec3_fma_scale(eta, w, wo);
        float l2 = vec3_dot(h, h);
        if (!(l2 > 0.0f)) return;
        h = vec3_scale(h, (h.z < 0.0f ? -1.0f : 1.0f) / sqrt(l2));
        float wo_h = vec3_dot(wo, h), wi_h = vec3_dot(w, h);
        if (wo_h <= 0.0f || (b->solid && wi_h >= 0.0f)) return;
        base_microfacet(b, wo_h, &reflected, &transmitted);
        float reflect = base_reflect_probability(b, reflected, transmitted);
        if (reflect < 0.0f) return;
        float d = base_distribution(b, h);
        /* |d omega_h / d omega_i|: Walter et al. 2007 eq. 17; a thin wall mirrors the reflection */
        float jacobian = b->solid ? eta * eta * -wi_h / l2 : 1.0f / (4.0f * wo_h);
        float masking = ggx_masking(wo.z, b->stretch, -wi.z, base_stretch(b, wi));
        *f = colour_add(*f, colour_scale(transmitted, base_body_scale(b) * wo_h * jacobian * d * masking));
        /* a normal of ggx_sample within the cap */
        float a2 = b->alpha * b->alpha;
        uint in_cap =
            2.0f * wo_h * h.z * a2 >= (1.0f - b->cap) * wo.z * fma(a2, h.z * h.z, fma(h.x, h.x, h.y * h.y));
#if BSDF_STRETCHED
        if (b->alpha_x != b->alpha)
            in_cap = 2.0f * wo_h * h.z >=
                     (1.0f - b->cap) * wo.z *
                         fma(h.z, h.z, math_square(h.x / b->alpha_x) + math_square(h.y / b->alpha));
#endif
        *pdf +=
            b->p_specular * (1.0f - reflect) * jacobian * 2.0f * d * wo_h * base_cap_factor(b, wo.z, in_cap);
        return;
    }
#endif
    Vec3 h = vec3_add(wo, wi);
    float c = 0.5f * vec3_length(h); /* |wo + wi| = 2 wo.h */
    if (!(c > 0.0f)) return;         /* both in the plane, opposite */
    base_microfacet(b, c, &reflected, &transmitted);
    float reflect = base_reflect_probability(b, reflected, transmitted);
    if (reflect < 0.0f) return;
    float d = base_distribution(b, h);
    float masking = ggx_masking(wo.z, b->stretch, wi.z, base_stretch(b, wi));
    *f = colour_add(*f, colour_scale(reflected, 0.25f * d * masking));
#if BSDF_TRANSMISSION
    if (b->transmits) {
        *pdf += b->p_specular * reflect * 0.5f * d * base_cap_factor(b, wo.z, 1u);
        return;
    }
#endif
    *pdf += b->p_specular * reflect * ggx_reflection_pdf(d, wo.z, b->stretch, b->cap);
}
#endif

/* f |cos wi| and its pdf over all lobes; delta lobes excluded. */
TRIAD_FUNCTION_PER_CALL Colour base_eval(const BaseBsdf* b, Vec3 wo, Vec3 wi, float* pdf) {
    Colour f = colour_splat(0.0f);
    *pdf = 0.0f;
    if (wi.z > 0.0f) {
        float lambert = wi.z * MATH_INV_PI;
        f = colour_scale(b->diffuse, lambert);
        *pdf = lambert;
#if TRIAD_DIFFUSE_TRANSMISSION
        *pdf *= 1.0f - b->p_through;
    } else if (b->p_through > 0.0f) {
        float lambert = -wi.z * MATH_INV_PI;
        f = colour_scale(b->diffuse_through, lambert);
        *pdf = lambert * b->p_through;
#endif
    }
#if TRIAD_SPECULAR
    if (b->p_specular > 0.0f) {
        *pdf *= 1.0f - b->p_specular;
        uint lit = wi.z > 0.0f;
#if BSDF_TRANSMISSION
        lit = lit || (b->transmits && wi.z < 0.0f);
#endif
        if (lit && !b->smooth) base_eval_microfacets(b, wo, wi, &f, pdf);
    }
#else
    (void)wo;
#endif
    return f;
}

/* One sample: `numbers` pick the lobe and the direction, u_through whether it goes through a boundary; all in
 * [0, 1). */
TRIAD_FUNCTION BsdfSample base_sample(const BaseBsdf* b, Vec3 wo, float u_through, Vec2 numbers) {
    Vec2 u = numbers;
    BsdfSample s;
    (void)u_through;
    s.wi = vec3_make(0.0f, 0.0f, 1.0f);
    s.weight = colour_splat(0.0f);
    s.pdf = 0.0f;
    s.event = BSDF_NONE;
#if TRIAD_SPECULAR
    if (sampling_choose(&u.x, b->p_specular)) {
        float cap = b->cap;
#if BSDF_TRANSMISSION
        if (b->p_cap > 0.0f && !sampling_choose(&u.y, b->p_cap)) cap = 1.0f;
#endif
        Vec3 h = b->smooth ? vec3_make(0.0f, 0.0f, 1.0f) : base_normal(b, wo, cap, u);
        float c = b->smooth ? wo.z : math_min(vec3_dot(wo, h), 1.0f);
        Colour reflected, transmitted;
        base_microfacet(b, c, &reflected, &transmitted);
        float reflect = base_reflect_probability(b, reflected, transmitted);
        if (c <= 0.0f || reflect < 0.0f) return s;
        uint through = 0u;
#if BSDF_TRANSMISSION
        through = b->transmits && u_through >= reflect;
        if (through && b->solid) {
            s.wi = vec3_fma_scale(c / b->eta - fresnel_refracted_cosine(c, b->eta), h,
                                  vec3_scale(wo, -1.0f / b->eta));
            if (b->eta == 1.0f) s.wi = vec3_negate(wo);
        } else
#endif
        {
            s.wi = vec3_reflect(wo, h);
            if (through) s.wi.z = -s.wi.z;
        }
        if (through ? s.wi.z >= 0.0f : s.wi.z <= 0.0f) return s; /* single scattering ends in the surface */
        s.event = (b->smooth ? BSDF_DELTA : BSDF_GLOSSY) | (through ? BSDF_TRANSMIT : 0u);
#if TRIAD_DIFFUSE_TRANSMISSION
        if (through && b->p_through > 0.0f && !b->smooth) s.event |= BSDF_CLOUDED;
#endif
        if (b->smooth) {
            float p = b->p_specular * (through ? 1.0f - reflect : reflect);
            s.weight = colour_div(through ? transmitted : reflected, colour_splat(p));
#if BSDF_TRANSMISSION
            if (through) s.weight = colour_scale(s.weight, base_body_scale(b));
#endif
            return s;
        }
        s.wi = vec3_normalize(s.wi);
    } else
#endif
    {
#if TRIAD_DIFFUSE_TRANSMISSION
        const uint through = sampling_choose(&u.x, b->p_through);
#endif
        s.wi = sampling_cosine(u);
        s.event = BSDF_DIFFUSE;
        uint alone = 1u;
#if TRIAD_SPECULAR
        alone = !(b->p_specular > 0.0f);
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
        alone = alone && !(b->p_through > 0.0f);
        if (through) {
            s.wi.z = -s.wi.z;
            s.event |= BSDF_TRANSMIT;
        }
#endif
        if (alone) { /* nothing but one Lambert lobe */
            s.weight = b->diffuse;
            s.pdf = sampling_cosine_pdf(s.wi.z);
            return s;
        }
    }
    bsdf_weigh(&s, base_eval(b, wo, s.wi, &s.pdf));
    return s;
}

#endif
