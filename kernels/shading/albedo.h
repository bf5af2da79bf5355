/* Lookups in the directional-albedo tables; layout in types.h. */
#ifndef TRIAD_SHADING_ALBEDO_H
#define TRIAD_SHADING_ALBEDO_H

#include "common/vector.h"

/* Position x in [0, 1] on an axis of `size` nodes: lower node, and the weight of the upper one. */
TRIAD_FUNCTION uint albedo_node(float x, uint size, float* t) {
    float p = math_saturate(x) * (float)(size - 1u);
    uint i = (uint)p;
    i = i < size - 2u ? i : size - 2u;
    *t = p - (float)i;
    return i;
}
TRIAD_FUNCTION Vec2 albedo_bilinear(global const float* table, uint size, uint row, uint column, float ty,
                                    float tx) {
    global const float* p = table + (row * size + column) * 2u;
    Vec2 a = vec2_load(p, 0), b = vec2_load(p, 1), c = vec2_load(p, size), d = vec2_load(p, size + 1u);
    return vec2_mix(vec2_mix(a, b, tx), vec2_mix(c, d, tx), ty);
}
/* (E, B): albedo of GGX reflection with Fresnel factor 1 and with (1 - cos)^5. */
TRIAD_FUNCTION Vec2 albedo_ggx(global const float* tables, float root_mu, float roughness) {
    float ty, tx;
    uint row = albedo_node(roughness, ALBEDO_SIZE, &ty), column = albedo_node(root_mu, ALBEDO_SIZE, &tx);
    return albedo_bilinear(tables, ALBEDO_SIZE, row, column, ty, tx);
}
/* A rough dielectric body seen from outside or inside, without the change of radiance by its index:
 * (reflection plus transmission, the same if only total reflection reflected). f0 = ((n - 1) / (n + 1))^2. */
TRIAD_FUNCTION Vec2 albedo_glass(global const float* tables, float root_mu, float roughness, float f0,
                                 uint inside) {
    float tz, ty, tx;
    uint plane = albedo_node(sqrt(sqrt(f0) * (1.0f / ALBEDO_GLASS_MAX)), ALBEDO_GLASS_SIZE, &tz);
    uint row = albedo_node(roughness, ALBEDO_GLASS_SIZE, &ty),
         column = albedo_node(root_mu, ALBEDO_GLASS_SIZE, &tx);
    const uint side = ALBEDO_GLASS_SIZE * ALBEDO_GLASS_SIZE * 2u;
    global const float* table = tables + ALBEDO_GLASS_FIRST + (inside * ALBEDO_GLASS_SIZE + plane) * side;
    Vec2 lo = albedo_bilinear(table, ALBEDO_GLASS_SIZE, row, column, ty, tx);
    Vec2 hi = albedo_bilinear(table + side, ALBEDO_GLASS_SIZE, row, column, ty, tx);
    return vec2_mix(lo, hi, tz);
}

#if TRIAD_ANISOTROPY
/* (E, B) as albedo_ggx, of GGX with alpha roughness^2 along y and mix(alpha, 1, strength^2) along x; wo in
 * that frame. Most of it is that of the alpha along wo, which the masking knows alone; the rest is a table.
 */
TRIAD_FUNCTION Vec2 albedo_anisotropic(global const float* tables, float root_mu, Vec3 wo, float roughness,
                                       float strength) {
    const float x = fabs(wo.x), y = fabs(wo.y), along2 = fma(x, x, y * y);
    const float turn = along2 > 0.0f ? math_atan2(y, x) * (2.0f * MATH_INV_PI) : 0.0f;
    float tr, ts, tp, tm;
    const uint r = albedo_node(roughness, ALBEDO_LONG, &tr), s = albedo_node(strength, ALBEDO_SHORT, &ts),
               p = albedo_node(turn, ALBEDO_SHORT, &tp), m = albedo_node(root_mu, ALBEDO_LONG, &tm);
    global const float* table = tables + ALBEDO_ANISOTROPIC_FIRST;
    const float alpha = roughness * roughness, alpha_x = fma(1.0f - alpha, strength * strength, alpha);
    const float share = along2 > 0.0f ? x * x / along2 : 1.0f;
    const float alpha2 = math_mix(alpha * alpha, alpha_x * alpha_x, share);
    Vec2 value = albedo_ggx(tables, root_mu, sqrt(sqrt(alpha2)));
    for (uint k = 0u; k < 4u; ++k) {
        const uint upper_r = k & 1u, upper_s = k >> 1;
        const uint plane = (r + upper_r) * ALBEDO_SHORT + s + upper_s;
        const float weight = (upper_r ? tr : 1.0f - tr) * (upper_s ? ts : 1.0f - ts);
        global const float* square = table + plane * (ALBEDO_SHORT * ALBEDO_LONG * 2u);
        value = vec2_add(value, vec2_scale(albedo_bilinear(square, ALBEDO_LONG, p, m, tp, tm), weight));
    }
    return value;
}
#endif

#if TRIAD_SHEEN
/* Of the white sheen lobe. */
TRIAD_FUNCTION float albedo_sheen(global const float* tables, float root_mu, float roughness) {
    float ty, tx;
    const uint row = albedo_node((roughness - SHEEN_MIN_ROUGHNESS) / (1.0f - SHEEN_MIN_ROUGHNESS),
                                 ALBEDO_SIZE, &ty),
               column = albedo_node(root_mu, ALBEDO_SIZE, &tx);
    global const float* p = tables + ALBEDO_SHEEN_FIRST + row * ALBEDO_SIZE + column;
    return math_mix(math_mix(p[0], p[1], tx), math_mix(p[ALBEDO_SIZE], p[ALBEDO_SIZE + 1], tx), ty);
}
#endif

#endif
