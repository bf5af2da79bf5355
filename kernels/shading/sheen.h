/* KHR_materials_sheen: fibres that stand upright (Estevez and Kulla 2017, "Production Friendly Microfacet
 * Sheen BRDF"), with the masking of the extension's text. */
#ifndef TRIAD_SHADING_SHEEN_H
#define TRIAD_SHADING_SHEEN_H

#include "common/sampling.h"
#include "shading/albedo.h"
#include "shading/bsdf_input.h"

#if TRIAD_SHEEN
typedef struct SheenLobe {
    Colour colour;
    float inverse_alpha;
    float mix;    /* (1 - alpha)^2, between the masking's two fits */
    float cosine; /* of wo, bounded as sheen_cosine() does */
    float lambda_wo;
    float scale;  /* where the formula gives more light than there is, at grazing angles: its inverse */
    float albedo; /* of the white lobe as seen from wo */
} SheenLobe;

/* The fit of the masking, x in [0, 1]. */
TRIAD_FUNCTION float sheen_fit(float x, float t) {
    const float a = math_mix(21.5473f, 25.3245f, t), b = math_mix(3.82987f, 3.32435f, t),
                c = math_mix(0.19823f, 0.16801f, t), d = math_mix(-1.97760f, -1.27393f, t),
                e = math_mix(-4.32054f, -4.85967f, t);
    return a / fma(b, math_pow(x, c), 1.0f) + fma(d, x, e);
}
/* Lambda of a direction with this cosine, which is above 0. */
TRIAD_FUNCTION float sheen_lambda(float c, float t) {
    if (c < 0.5f) return math_exp(sheen_fit(c, t));
    return math_exp(fma(2.0f, sheen_fit(0.5f, t), -sheen_fit(math_max(1.0f - c, 0.0f), t)));
}

/* The fit of Lambda ends at e^17 and the formula divides by the cosine: closer to the horizon the lobe would
 * grow without bound, and stays what it is there. */
TRIAD_FUNCTION float sheen_cosine(float c) { return math_max(c, SHEEN_MIN_COSINE); }

TRIAD_FUNCTION SheenLobe sheen_make(const BsdfInput* in, Vec3 wo, global const float* albedo_tables) {
    SheenLobe s;
    s.colour = in->sheen;
    s.albedo = 0.0f;
    if (!(colour_largest(in->sheen) > 0.0f)) return s;
    const float roughness = math_max(in->sheen_roughness, SHEEN_MIN_ROUGHNESS), alpha = roughness * roughness;
    s.inverse_alpha = 1.0f / alpha;
    s.mix = math_square(1.0f - alpha);
    s.cosine = sheen_cosine(wo.z);
    s.lambda_wo = sheen_lambda(s.cosine, s.mix);
    const float albedo = albedo_sheen(albedo_tables, s.cosine, roughness);
    s.scale = 1.0f / math_max(albedo, 1.0f);
    s.albedo = math_min(albedo, 1.0f);
    return s;
}

/* f |cos wi| of the white lobe; wi.z > 0. */
TRIAD_FUNCTION float sheen_eval(const SheenLobe* s, Vec3 wo, Vec3 wi) {
    const float cosine = sheen_cosine(wi.z);
    Vec3 h = vec3_make(wo.x + wi.x, wo.y + wi.y, s->cosine + cosine);
    float l2 = vec3_dot(h, h);
    if (!(l2 > 0.0f)) return 0.0f;
    /* sin^(1 / alpha) of the angle to the normal */
    float sine2 = math_min(fma(h.x, h.x, h.y * h.y) / l2, 1.0f);
    float d = (2.0f + s->inverse_alpha) * math_pow(sine2, 0.5f * s->inverse_alpha) * (0.5f * MATH_INV_PI);
    float shadowed = 1.0f + s->lambda_wo + sheen_lambda(cosine, s->mix);
    return s->scale * d / (4.0f * s->cosine * shadowed) * (wi.z / cosine);
}
#endif

#endif
