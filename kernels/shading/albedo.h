/* Lookups in the directional-albedo tables; layout in types.h. */
#ifndef TRIAD_SHADING_ALBEDO_H
#define TRIAD_SHADING_ALBEDO_H

#include "common/vector.h"
#include "shading/fresnel.h"

/* Position x in [0, 1] on an axis of `size` nodes: lower node, and the weight of the upper one. */
TRIAD_FUNCTION uint albedo_node(float x, uint size, float* t) {
    float p = math_saturate(x) * (float)(size - 1u);
    uint i = (uint)p;
    i = i < size - 2u ? i : size - 2u;
    *t = p - (float)i;
    return i;
}
TRIAD_FUNCTION Vec2 albedo_bilinear(global const float* table, uint columns, uint row, uint column, float ty,
                                    float tx) {
    global const float* p = table + (row * columns + column) * 2u;
    Vec2 a = vec2_load(p, 0), b = vec2_load(p, 1), c = vec2_load(p, columns), d = vec2_load(p, columns + 1u);
    return vec2_mix(vec2_mix(a, b, tx), vec2_mix(c, d, tx), ty);
}
/* Where a direction is on the axis of columns: s is the root of its cosine. */
TRIAD_FUNCTION float albedo_column(float s, float roughness) {
    return s * (1.0f + roughness) / math_max(s + roughness, 1e-20f);
}
/* (E, B / E - (1 - mu)^5) of GGX reflection. */
TRIAD_FUNCTION Vec2 albedo_ggx_nodes(global const float* tables, float root_mu, float roughness) {
    float ty, tx;
    uint row = albedo_node(roughness, ALBEDO_SIZE, &ty),
         column = albedo_node(albedo_column(root_mu, roughness), ALBEDO_SIZE, &tx);
    return albedo_bilinear(tables, ALBEDO_SIZE, row, column, ty, tx);
}
/* (E, B) of two values of a table. */
TRIAD_FUNCTION Vec2 albedo_of_nodes(Vec2 nodes, float mu) {
    return vec2_make(nodes.x, nodes.x * (nodes.y + fresnel_schlick_weight(mu)));
}
/* (E, B): albedo of GGX reflection with Fresnel factor 1 and with (1 - cos)^5. */
TRIAD_FUNCTION Vec2 albedo_ggx(global const float* tables, float mu, float roughness) {
    return albedo_of_nodes(albedo_ggx_nodes(tables, sqrt(mu), roughness), mu);
}
/* log2(ALBEDO_GLASS_MOST / ALBEDO_GLASS_LEAST); and, with g the ratio of n - 1 of neighbouring nodes,
 * 4 (1/2 - 1 / (sqrt(g) + 1)): weights linear in n from ones linear in its logarithm. */
#define ALBEDO_GLASS_OCTAVES 8.22881869f
#define ALBEDO_GLASS_BEND 0.0919f
/* A rough dielectric body seen from outside or inside, without the change of radiance by its index:
 * (reflection plus transmission, the same if only total reflection reflected). f0 = ((n - 1) / (n + 1))^2. */
TRIAD_FUNCTION Vec2 albedo_glass(global const float* tables, float mu, float roughness, float f0,
                                 uint inside) {
    const float root = sqrt(f0), alpha = math_max(roughness * roughness, 1e-4f); /* the table's least */
    const float excess =
        math_clamp(2.0f * root / (1.0f - root), ALBEDO_GLASS_LEAST, ALBEDO_GLASS_MOST); /* n - 1 */
    float tz, ty, tx;
    const uint plane =
        albedo_node(math_log2(excess * (1.0f / ALBEDO_GLASS_LEAST)) * (1.0f / ALBEDO_GLASS_OCTAVES),
                    ALBEDO_GLASS_INDICES, &tz);
    tz = fma(ALBEDO_GLASS_BEND * tz, tz - 1.0f, tz);
    const float per_b = (1.0f / alpha + 1.0f / excess) * (1.0f / ALBEDO_GLASS_SCALE);
    const uint row = albedo_node(sqrt(fma(2.0f, roughness, 0.25f)) - 0.5f, ALBEDO_GLASS_ROUGHNESSES, &ty),
               column = albedo_node(math_log2(fma(mu, per_b, 1.0f)) / math_log2(1.0f + per_b),
                                    ALBEDO_GLASS_COLUMNS, &tx);
    const uint size = ALBEDO_GLASS_ROUGHNESSES * ALBEDO_GLASS_COLUMNS * 2u;
    global const float* table = tables + ALBEDO_GLASS_FIRST + inside * ALBEDO_GLASS_SIDE + plane * size;
    const Vec2 lo = albedo_bilinear(table, ALBEDO_GLASS_COLUMNS, row, column, ty, tx);
    const Vec2 hi = albedo_bilinear(table + size, ALBEDO_GLASS_COLUMNS, row, column, ty, tx);
    return vec2_mix(lo, hi, tz);
}

#if TRIAD_ANISOTROPY
/* z / hypot(x, z), also where the square of z is none. */
TRIAD_FUNCTION float albedo_slope(float z, float x2) { return z / math_max(sqrt(fma(z, z, x2)), z); }
/* (E, B) as albedo_ggx, of GGX with alpha roughness^2 along y and mix(alpha, 1, strength^2) along x; wo in
 * that frame. Grooves along y keep the light's plane: their albedo is a function of x / z alone, whatever y.
 */
TRIAD_FUNCTION Vec2 albedo_stretched(global const float* tables, Vec3 wo, float roughness, float strength) {
    const float x2 = wo.x * wo.x, y2 = wo.y * wo.y, along2 = x2 + y2;
    const float alpha = roughness * roughness, alpha_x = fma(1.0f - alpha, strength * strength, alpha);
    float tr, ts, tx, ty;
    const uint r = albedo_node(roughness, ALBEDO_STRETCHED_ROUGHNESSES, &tr),
               s = albedo_node(strength, ALBEDO_STRETCHED_STRENGTHS, &ts),
               x = albedo_node(albedo_column(sqrt(albedo_slope(wo.z, x2)), sqrt(alpha_x)),
                               ALBEDO_STRETCHED_SIZE, &tx),
               y = albedo_node(albedo_column(sqrt(albedo_slope(wo.z, y2)), roughness), ALBEDO_STRETCHED_SIZE,
                               &ty);
    const float share = along2 > 0.0f ? x2 / along2 : 1.0f;
    const float along = math_mix(alpha * alpha, alpha_x * alpha_x, share);
    const Vec2 round = albedo_ggx_nodes(tables, sqrt(wo.z), sqrt(sqrt(along)));
    Vec2 value = vec2_make(0.0f, round.y);
    for (uint k = 0u; k < 4u; ++k) {
        const uint upper_r = k & 1u, upper_s = k >> 1;
        const uint strong = s + upper_s;
        const float weight = (upper_r ? tr : 1.0f - tr) * (upper_s ? ts : 1.0f - ts);
        global const float* square = tables + ALBEDO_STRETCHED_FIRST +
                                     ((r + upper_r) * ALBEDO_STRETCHED_STRENGTHS + strong) *
                                         (ALBEDO_STRETCHED_SIZE * ALBEDO_STRETCHED_SIZE * 2u);
        /* what is hardly stretched fades into what is round */
        const Vec2 node =
            strong ? albedo_bilinear(square, ALBEDO_STRETCHED_SIZE, x, y, tx, ty) : vec2_make(round.x, 0.0f);
        value = vec2_add(value, vec2_scale(node, weight));
    }
    return albedo_of_nodes(value, wo.z);
}
#endif

#if TRIAD_SHEEN
/* Of the white sheen lobe; cosine and roughness not below their minima. */
TRIAD_FUNCTION float albedo_sheen(global const float* tables, float cosine, float roughness) {
    float ty, tx;
    const float y = (roughness - SHEEN_MIN_ROUGHNESS) / (1.0f - SHEEN_MIN_ROUGHNESS),
                x = (sqrt(sqrt(cosine)) - SHEEN_MIN_COSINE_ROOT) / (1.0f - SHEEN_MIN_COSINE_ROOT);
    const uint row = albedo_node(sqrt(y), ALBEDO_SHEEN_SIZE, &ty),
               column = albedo_node(x, ALBEDO_SHEEN_SIZE, &tx);
    global const float* p = tables + ALBEDO_SHEEN_FIRST + row * ALBEDO_SHEEN_SIZE + column;
    return math_mix(math_mix(p[0], p[1], tx), math_mix(p[ALBEDO_SHEEN_SIZE], p[ALBEDO_SHEEN_SIZE + 1], tx),
                    ty);
}
#endif

#endif
