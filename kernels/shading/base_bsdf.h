/* The core of the glTF material: mix(dielectric, metal), where a dielectric is a coated diffuse base or, by
 * `transmission`, a thin wall or the boundary of a solid body. Its microfacets may be stretched (anisotropy)
 * or covered by a thin film (iridescence), and a share of the diffuse base may leave on the other side.
 * Formulas, sources and what is not reciprocal: docs/shading.md. Conventions: shading/bsdf.h.
 */
#ifndef TRIAD_SHADING_BASE_BSDF_H
#define TRIAD_SHADING_BASE_BSDF_H

#include "common/sampling.h"
#include "shading/albedo.h"
#include "shading/bsdf_input.h"
#include "shading/ggx.h"
#include "shading/thin_film.h"

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
    float film_share; /* of a transmitter's reflectance */
#endif
    float stretch;    /* ggx_stretch of wo */
    float cap;        /* ggx_cap of wo; 1: normals are not bounded */
    float p_specular; /* probability of sampling the microfacets and not the Lambert lobe */
    uint smooth;      /* the microfacets are one mirror: delta lobes */
#endif
#if BSDF_TRANSMISSION
    uint transmits;
    uint solid;
    float eta;                 /* index beyond the surface over index before it */
    float body_scale;          /* of radiance that crosses: 1 / eta^2 of a solid body, else 1 */
    Colour fresnel0, fresnel1; /* F of the transmitter = fresnel0 + fresnel1 * F of the bare interface */
    Colour transmitter;        /* its weight, energy compensation included */
    Colour tint;
    float p_cap; /* of a transmitter: probability that the normal is drawn within the cap */
#endif
} BaseBsdf;

#if BSDF_TRANSMISSION
/* Fresnel factor of the transmitting part, c the cosine on wo's side. */
TRIAD_FUNCTION Colour base_transmitter_fresnel(const BaseBsdf* b, float c) {
    float r = fresnel_dielectric(c, b->eta);
    if (r >= 1.0f) return colour_splat(1.0f);
    Colour f = colour_fma_scale(r, b->fresnel1, b->fresnel0);
    /* Brewster's dip goes below normal incidence */
    f = colour_at_least(f, colour_splat(0.0f));
#if BSDF_FILM
    if (b->film_share > 0.0f) { /* as seen from outside: a reflection has no side */
        float outside = b->eta < 1.0f ? fresnel_refracted_cosine(c, b->eta) : c;
        f = colour_fma_scale(b->film_share,
                             colour_sub(film_reflectance(&b->film_input, b->film0, outside), f), f);
    }
#endif
    /* both faces of a thin wall and all reflections between them: R = 2F / (1 + F), T = (1 - F) / (1 + F) */
    return b->solid ? f : colour_div(colour_scale(f, 2.0f), colour_add(colour_splat(1.0f), f));
}
#endif

#if TRIAD_SPECULAR
/* What a microfacet reflects and lets through (change of radiance not included) at wo.h = c. */
TRIAD_FUNCTION void base_microfacet(const BaseBsdf* b, float c, Colour* reflected, Colour* transmitted) {
    *reflected = colour_fma_scale(fresnel_schlick_weight(c), b->specular1, b->specular0);
#if BSDF_FILM
    if (colour_largest(b->film) > 0.0f)
        *reflected = colour_fma(b->film, film_reflectance(&b->film_input, b->film0, c), *reflected);
#endif
    *transmitted = colour_splat(0.0f);
#if BSDF_TRANSMISSION
    if (b->transmits) {
        Colour f = base_transmitter_fresnel(b, c);
        *reflected = colour_add(*reflected, colour_mul(b->transmitter, f));
        *transmitted = colour_mul(colour_mul(b->transmitter, b->tint), colour_complement(f));
    }
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

#if BSDF_FILM
/* Mean of the film's reflectance over the reflections of the rough base, weighted as they are seen. */
TRIAD_FUNCTION Colour base_film_mean(const BaseBsdf* b, Vec3 wo) {
    if (b->smooth) return film_reflectance(&b->film_input, b->film0, wo.z);
    Colour sum = colour_splat(0.0f);
    float weights = 0.0f;
    for (uint k = 0u; k < 16u; ++k) {
        Vec2 u = vec2_make((float)k * 0.618034f, ((float)k + 0.5f) * 0.0625f);
        Vec3 h = base_normal(b, wo, 1.0f, vec2_make(u.x - math_floor(u.x), u.y));
        float c = math_min(vec3_dot(wo, h), 1.0f);
        Vec3 wi = vec3_reflect(wo, h);
        if (wi.z <= 0.0f) continue;
        float g = ggx_masking(wo.z, b->stretch, wi.z, base_stretch(b, wi)) * (wo.z + b->stretch);
        sum = colour_fma_scale(g, film_reflectance(&b->film_input, b->film0, c), sum);
        weights += g;
    }
    return weights > 0.0f ? colour_scale(sum, 1.0f / weights)
                          : film_reflectance(&b->film_input, b->film0, wo.z);
}
#endif

#if BSDF_FILM
/* The film's share of what the microfacets reflect; `kept` is the albedo of the rough base with Fresnel
 * factor 1, coat_albedo of what covers the Lambert lobe. Returns the albedo of that share. */
TRIAD_FUNCTION float base_add_film(BaseBsdf* b, const BsdfInput* in, Vec3 wo, float opaque, float kept,
                                   Colour* coat_albedo) {
    b->film_input = in->film_input;
    Colour mean = base_film_mean(b, wo);
    Colour whole = colour_fma_scale((1.0f - kept) / kept, mean, colour_splat(1.0f));
    Colour film_albedo = colour_scale(colour_mul(whole, mean), in->film * kept);
    float weight = fma(opaque, in->specular, in->metallic);
    b->film = colour_scale(whole, in->film * weight);
    b->film_share = in->film;
    b->specular0 = colour_scale(b->specular0, 1.0f - in->film);
    b->specular1 = colour_scale(b->specular1, 1.0f - in->film);
    *coat_albedo = colour_fma_scale(in->specular, film_albedo, colour_scale(*coat_albedo, 1.0f - in->film));
    return colour_average(film_albedo) * weight;
}
#endif

#if BSDF_TRANSMISSION
/* Of the density of a transmitter's normals h, the factor that a cap changes: 1 / (z + s) without one. */
TRIAD_FUNCTION float base_cap_factor(const BaseBsdf* b, float z_o, uint in_cap) {
    float bounded = in_cap ? b->p_cap / fma(b->cap, z_o, b->stretch) : 0.0f;
    return bounded + (1.0f - b->p_cap) / (z_o + b->stretch);
}
#endif

/* The Lambert base, of which `share` is seen; returns its albedo. */
TRIAD_FUNCTION float base_lambert(BaseBsdf* b, const BsdfInput* in, float share) {
    b->diffuse = colour_scale(in->base_colour, share);
    float albedo = colour_average(b->diffuse);
#if TRIAD_DIFFUSE_TRANSMISSION
    b->diffuse_through = colour_splat(0.0f);
    b->p_through = 0.0f;
    if (in->through > 0.0f) {
        b->diffuse = colour_scale(b->diffuse, 1.0f - in->through);
        b->diffuse_through = colour_scale(in->through_colour, share * in->through);
        float through = colour_average(b->diffuse_through);
        albedo = colour_average(b->diffuse) + through;
        b->p_through = albedo > 0.0f ? through / albedo : 0.0f;
    }
#endif
    return albedo;
}

/* wo.z > 0. Colours in [0, 1], metallic, roughness, specular, transmission in [0, 1], ior 0 or at least 1. */
TRIAD_FUNCTION BaseBsdf base_make(const BsdfInput* in, Vec3 wo, global const float* albedo_tables) {
    BaseBsdf b;
#if !TRIAD_SPECULAR
    (void)wo, (void)albedo_tables;
    (void)base_lambert(&b, in, 1.0f);
#if BSDF_LAYERED
    b.albedo = colour_average(in->base_colour);
#endif
#else
    float f0 = fresnel_normal(in->ior);
    Colour coat0 =
        colour_scale(colour_at_most(colour_scale(in->specular_colour, f0), colour_splat(1.0f)), in->specular);
    Colour coat90 = colour_splat(in->specular);
    float dielectric = 1.0f - in->metallic;
    float opaque = dielectric;
    b.alpha = math_square(in->roughness);
    b.smooth = b.alpha < BSDF_SMOOTH_ALPHA;
#if BSDF_STRETCHED
    b.alpha_x = fma(1.0f - b.alpha, math_square(in->anisotropy), b.alpha);
    if (b.smooth && b.alpha_x >= BSDF_SMOOTH_ALPHA) b.smooth = 0u, b.alpha = BSDF_SMOOTH_ALPHA;
#endif
#if BSDF_FILM
    b.film = colour_splat(0.0f);
    b.film_share = 0.0f;
#endif
#if BSDF_TRANSMISSION
    float transmitter = in->ior >= 1.0f && f0 < 1.0f ? dielectric * in->transmission : 0.0f;
    opaque = dielectric - transmitter;
    b.transmits = transmitter > 0.0f;
    b.solid = in->solid;
    if (b.transmits && in->solid && in->ior < 1.0f + BSDF_SAME_INDEX) b.smooth = 1u;
#endif
    uint lambert = in->metallic == 0.0f && in->specular == 0.0f;
#if BSDF_TRANSMISSION
    lambert = lambert && !b.transmits;
#endif
    if (lambert) { /* what follows would come to the same bits */
        b.specular0 = b.specular1 = colour_splat(0.0f);
        b.p_specular = 0.0f;
        float lambert_albedo = base_lambert(&b, in, opaque);
#if BSDF_LAYERED
        b.albedo = lambert_albedo;
#else
        (void)lambert_albedo;
#endif
        return b;
    }
    /* directional albedo of GGX reflection, Fresnel factor 1 and (1 - cos)^5 */
    Vec2 albedo = vec2_make(1.0f, fresnel_schlick_weight(wo.z));
    float root_mu = sqrt(wo.z);
    if (!b.smooth) albedo = albedo_ggx(albedo_tables, root_mu, in->roughness);
#if BSDF_STRETCHED
    if (b.alpha_x != b.alpha)
        albedo = albedo_anisotropic(albedo_tables, root_mu, wo, sqrt(b.alpha), in->anisotropy);
#endif
    float missing = (1.0f - albedo.x) / albedo.x; /* Turquin 2019: f = f_single (1 + F0 (1 - E) / E) */

    b.stretch = base_stretch(&b, wo);
    Colour metal0 = in->base_colour;
    Colour metal = colour_scale(colour_fma_scale(missing, metal0, colour_splat(1.0f)), in->metallic);
    Colour coat = colour_fma_scale(missing, coat0, colour_splat(1.0f));
    Colour opaque_coat = colour_scale(coat, opaque), coat_rise = colour_sub(coat90, coat0);
    b.specular0 = colour_fma(metal, metal0, colour_mul(opaque_coat, coat0));
    b.specular1 = colour_fma(metal, colour_complement(metal0), colour_mul(opaque_coat, coat_rise));
    Colour coat_albedo =
        colour_mul(coat, colour_fma_scale(albedo.y, coat_rise, colour_scale(coat0, albedo.x)));
    float film_albedo = 0.0f;
#if BSDF_FILM
    if (in->film > 0.0f) {
        b.film0 = colour_fma_scale(in->metallic, colour_sub(metal0, coat0), coat0);
        film_albedo = base_add_film(&b, in, wo, opaque, albedo.x, &coat_albedo);
    }
#endif
    float d = base_lambert(&b, in, opaque * math_max(0.0f, 1.0f - colour_largest(coat_albedo)));

    float p = colour_average(colour_fma_scale(albedo.y, b.specular1, colour_scale(b.specular0, albedo.x)));
    p += film_albedo;
    uint bounded = !b.smooth;
#if BSDF_TRANSMISSION
    b.p_cap = 0.0f;
    if (b.transmits) {
        bounded = 0u;
        b.fresnel1 = colour_div(coat_rise, colour_splat(1.0f - f0));
        b.fresnel0 = colour_fma_scale(-f0, b.fresnel1, coat0);
        b.tint = in->base_colour;
        b.eta = in->solid && in->inside ? 1.0f / in->ior : in->ior;
        b.body_scale = in->solid ? 1.0f / (b.eta * b.eta) : 1.0f;
        b.transmitter = colour_splat(transmitter);
        if (!b.smooth) {
            Colour kept = colour_splat(albedo.x);
            if (in->solid) {
                Vec2 glass = albedo_glass(albedo_tables, root_mu, in->roughness, f0, in->inside);
                Colour lost = colour_sub(colour_complement(b.fresnel0), b.fresnel1);
                kept = colour_add(
                    colour_add(colour_scale(b.fresnel0, albedo.x), colour_scale(b.fresnel1, glass.x)),
                    colour_scale(lost, glass.y));
            }
            b.transmitter = colour_div(colour_splat(transmitter), kept);
            /* Inside a rough body most normals reflect totally, and many of them into the surface. Samples
             * that end there make the others heavy, bounce after bounce: the cap leaves most of them out. */
            if (in->solid && in->inside) b.p_cap = math_saturate(1.0f - colour_average(kept));
            bounded = b.p_cap > 0.0f;
        }
        Colour f = base_transmitter_fresnel(&b, wo.z);
        Colour seen = colour_add(f, colour_mul(colour_complement(f), b.tint));
        p += transmitter * math_max(colour_average(seen), BSDF_MIN_TRANSMITTER);
    }
#endif
    b.cap = bounded ? ggx_cap(wo, b.alpha) : 1.0f;
#if BSDF_LAYERED
    b.albedo = p + d;
#endif
    b.p_specular = p > 0.0f ? (d > 0.0f ? p / (p + d) : 1.0f) : 0.0f;
#endif
    return b;
}

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
        *f = colour_add(*f, colour_scale(transmitted, b->body_scale * wo_h * jacobian * d * masking));
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

/* One sample: u_lobe picks the lobe, u the direction; all in [0, 1). */
TRIAD_FUNCTION BsdfSample base_sample(const BaseBsdf* b, Vec3 wo, float u_lobe, Vec2 u) {
    BsdfSample s;
    s.wi = vec3_make(0.0f, 0.0f, 1.0f);
    s.weight = colour_splat(0.0f);
    s.pdf = 0.0f;
    s.event = BSDF_NONE;
#if TRIAD_SPECULAR
    if (u_lobe < b->p_specular) {
        float cap = b->cap;
        Vec2 point = u;
#if BSDF_TRANSMISSION
        if (b->p_cap > 0.0f) {
            uint bounded = u.y < b->p_cap;
            point.y = bounded ? u.y / b->p_cap : (u.y - b->p_cap) / (1.0f - b->p_cap);
            point.y = math_min(point.y, 0x1.fffffep-1f);
            cap = bounded ? cap : 1.0f;
        }
#endif
        Vec3 h = b->smooth ? vec3_make(0.0f, 0.0f, 1.0f) : base_normal(b, wo, cap, point);
        float c = b->smooth ? wo.z : math_min(vec3_dot(wo, h), 1.0f);
        Colour reflected, transmitted;
        base_microfacet(b, c, &reflected, &transmitted);
        float reflect = base_reflect_probability(b, reflected, transmitted);
        if (c <= 0.0f || reflect < 0.0f) return s;
        uint through = 0u;
#if BSDF_TRANSMISSION
        through = b->transmits && u_lobe >= reflect * b->p_specular;
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
        if (b->smooth) {
            float p = b->p_specular * (through ? 1.0f - reflect : reflect);
            s.weight = colour_div(through ? transmitted : reflected, colour_splat(p));
#if BSDF_TRANSMISSION
            if (through) s.weight = colour_scale(s.weight, b->body_scale);
#endif
            return s;
        }
        s.wi = vec3_normalize(s.wi);
    } else
#endif
    {
        s.wi = sampling_cosine(u);
        s.event = BSDF_DIFFUSE;
        uint alone = 1u;
        float before = 0.0f;
#if TRIAD_SPECULAR
        before = b->p_specular;
        alone = !(before > 0.0f);
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
        alone = alone && !(b->p_through > 0.0f);
        if (u_lobe - before < b->p_through * (1.0f - before)) {
            s.wi.z = -s.wi.z;
            s.event |= BSDF_TRANSMIT;
        }
#else
        (void)u_lobe, (void)before;
#endif
        if (alone) { /* nothing but one Lambert lobe */
            s.weight = b->diffuse;
            s.pdf = sampling_cosine_pdf(s.wi.z);
            return s;
        }
    }
    Colour f = base_eval(b, wo, s.wi, &s.pdf);
    if (!(s.pdf > 0.0f)) {
        s.event = BSDF_NONE;
        return s;
    }
    s.weight = colour_div(f, colour_splat(s.pdf));
    return s;
}

#endif
