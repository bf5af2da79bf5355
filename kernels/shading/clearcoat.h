/* KHR_materials_clearcoat: a varnish of index 1.5 that reflects by GGX about a normal of its own. */
#ifndef TRIAD_SHADING_CLEARCOAT_H
#define TRIAD_SHADING_CLEARCOAT_H

#include "common/frame.h"
#include "shading/albedo.h"
#include "shading/bsdf_input.h"
#include "shading/fresnel.h"
#include "shading/ggx.h"

#if TRIAD_CLEARCOAT
/* Reflectance of index 1.5 at normal incidence. */
#define COAT_F0 0.04f
/* The least roughness: a smooth varnish is sampled as any other, so that it needs no delta lobe. */
#define COAT_MIN_ROUGHNESS 1e-2f

typedef struct CoatLobe {
    ShadingFrame frame; /* about its normal, in the local frame of the material */
    Vec3 wo;            /* in that frame */
    float alpha, stretch, cap;
    float weight; /* factor, and what is lost by scattering once, given back (Turquin 2019) */
    float albedo; /* of the lobe as seen from wo */
} CoatLobe;

/* Albedo of the lobe as seen at a cosine to its normal; weight: as of CoatLobe. */
TRIAD_FUNCTION float coat_albedo(global const float* albedo_tables, float factor, float roughness,
                                 float cosine, float* weight) {
    Vec2 e = albedo_ggx(albedo_tables, math_min(cosine, 1.0f), math_max(roughness, COAT_MIN_ROUGHNESS));
    *weight = factor * fma((1.0f - e.x) / e.x, COAT_F0, 1.0f);
    return *weight * fma(COAT_F0, e.x, (1.0f - COAT_F0) * e.y);
}

TRIAD_FUNCTION CoatLobe coat_make(const BsdfInput* in, Vec3 wo, global const float* albedo_tables) {
    CoatLobe c;
    c.albedo = c.weight = 0.0f;
    if (!(in->coat > 0.0f)) return c;
    c.frame = frame_make(in->coat_normal);
    c.wo = frame_to_local(&c.frame, wo);
    if (!(c.wo.z > 0.0f)) return c;
    c.alpha = math_square(math_max(in->coat_roughness, COAT_MIN_ROUGHNESS));
    c.stretch = ggx_stretch(c.wo, c.alpha);
    c.cap = ggx_cap(c.wo, c.alpha);
    c.albedo = coat_albedo(albedo_tables, in->coat, in->coat_roughness, c.wo.z, &c.weight);
    return c;
}

/* f |cos wi| and its pdf; wi in the material's frame. */
TRIAD_FUNCTION float coat_eval(const CoatLobe* c, Vec3 wo, Vec3 wi, float* pdf) {
    (void)wo;
    *pdf = 0.0f;
    Vec3 w = frame_to_local(&c->frame, wi);
    Vec3 h = vec3_add(c->wo, w);
    float wo_h = 0.5f * vec3_length(h);
    if (!(w.z > 0.0f && wo_h > 0.0f)) return 0.0f;
    float d = ggx_distribution(h, c->alpha);
    float fresnel = fma(1.0f - COAT_F0, fresnel_schlick_weight(wo_h), COAT_F0);
    float masking = ggx_masking(c->wo.z, c->stretch, w.z, ggx_stretch(w, c->alpha));
    *pdf = ggx_reflection_pdf(d, c->wo.z, c->stretch, c->cap);
    return c->weight * fresnel * 0.25f * d * masking;
}

/* In the material's frame; what ends in the varnish has z <= 0. */
TRIAD_FUNCTION Vec3 coat_sample(const CoatLobe* c, Vec3 wo, Vec2 u) {
    (void)wo;
    Vec3 h = ggx_sample(c->wo, c->alpha, c->stretch, c->cap, u);
    Vec3 w = vec3_reflect(c->wo, h);
    if (w.z <= 0.0f) return vec3_make(0.0f, 0.0f, -1.0f);
    return vec3_normalize(frame_to_world(&c->frame, w));
}
#endif

#endif
