/* Light sampling of the environment map for where a surface faces: the map's light times the cosine at the
 * surface, as far as tables know it. The square of random numbers that draws from the map falls into patches
 * of equal probability; a facing, one of the cells of an octahedron, has a table of how many of its shares
 * each patch gets (after Clarberg et al. 2005, "Wavelet Importance Sampling": the product warps the numbers).
 * Within a patch directions are drawn as without a facing, so that the density of a direction is that of the
 * map times the shares of its patch, from the same integers. Every patch has a share in every facing: no
 * direction with light is lost, whatever the surface does. */
#ifndef TRIAD_SHADING_FACING_H
#define TRIAD_SHADING_FACING_H

#include "shading/environment.h"

#if TRIAD_ENVIRONMENT_MAP

/* The Receiver.facing for a Receiver.normal. */
TRIAD_FUNCTION uint facing_of(Vec3 n) {
    const float length = fabs(n.x) + fabs(n.y) + fabs(n.z), scale = 1.0f / length;
    if (length == 0.0f) return 0u;
    float a = n.x * scale, b = n.z * scale;
    const float c = 1.0f - fabs(b), d = 1.0f - fabs(a);
    const uint below = n.y < 0.0f; /* no branch, which could not be foreseen */
    a = below ? (a < 0.0f ? -c : c) : a;
    b = below ? (b < 0.0f ? -d : d) : b;
    /* NaN is the last cell */
    const uint i = (uint)math_min(fma(a, 0.5f * FACINGS, 0.5f * FACINGS), FACINGS - 0.5f);
    return 1u + FACINGS * i + (uint)math_min(fma(b, 0.5f * FACINGS, 0.5f * FACINGS), FACINGS - 0.5f);
}

/* The shares of a facing: of the rows of patches, and of the patches of a row. */
TRIAD_FUNCTION global const ushort* facing_rows(const Scene* scene, uint facing) {
    return scene->env_columns + scene->frame->environment.columns.size + (facing - 1u) * FACING_SHARES;
}
TRIAD_FUNCTION global const ushort* facing_columns(global const ushort* rows, uint row) {
    return rows + PATCHES + PATCHES * row;
}

/* How many shares entry i has, and the first of them. */
TRIAD_FUNCTION_PER_CALL uint facing_shares(global const ushort* entries, uint i, uint* first) {
    *first = i == 0u ? 0u : (uint)entries[i - 1u] + 1u;
    return (uint)entries[i] + 1u - *first;
}

#if PATCHES != 16
#error "facing_draw() takes sixteen entries"
#endif

/* The entry that u draws, as the upper bits of a number whose lower ones say where in its shares u lies. */
TRIAD_FUNCTION_PER_CALL uint facing_draw(global const ushort* entries, uint u, uint* entry, uint* shares) {
    const uint i = shares_below(entries, (ushort)(u >> 16));
    uint first;
    const uint n = facing_shares(entries, i, &first);
    *entry = i, *shares = n;
    const float within = (float)(u - (first << 16)) * (1.0f / (float)n); /* below 2^16, up to rounding */
    return i << (32u - PATCH_BITS) |
           (uint)(math_min(within, 0x1.fffffep15f) * (float)(1u << (16u - PATCH_BITS)));
}

/* 1 where a patch has its even part of 2^16 shares in both directions. */
TRIAD_FUNCTION float facing_factor(uint row_shares, uint column_shares) {
    return (float)row_shares * (float)column_shares * ((float)(PATCHES * PATCHES) * 0x1.0p-32f);
}

/* The numbers by which environment_sample() draws for this facing (not 0), and by what factor that is
 * likelier than without. */
TRIAD_FUNCTION_PER_CALL UVec2 facing_warp(const Scene* scene, uint facing, UVec2 u, float* factor) {
    global const ushort* rows = facing_rows(scene, facing);
    uint row, column, row_shares, column_shares;
    UVec2 warped;
    warped.y = facing_draw(rows, u.y, &row, &row_shares);
    warped.x = facing_draw(facing_columns(rows, row), u.x, &column, &column_shares);
    *factor = facing_factor(row_shares, column_shares);
    return warped;
}

/* That factor of a direction, which has the map coordinates uv. */
TRIAD_FUNCTION float facing_found(const Scene* scene, uint facing, Vec3 d, Vec2 uv) {
    global const Environment* e = &scene->frame->environment;
    const uint y = (uint)math_clamp_int((int)(uv.y * (float)e->height), 0, (int)e->height - 1);
    const uint x = (uint)math_clamp_int((int)(uv.x * (float)e->width), 0, (int)e->width - 1);
    const float c0 = scene->env_cosines[y], c1 = scene->env_cosines[y + 1u];
    global const uint* bounds = scene->env_rows + e->rows.first[e->rows.levels - 1u] + y;
    const uint number_y = bounds[0] + (uint)(math_clamp((d.y - c0) / (c1 - c0), 0.0f, 0x1.fffffep-1f) *
                                             (float)(bounds[1] - bounds[0]));
    uint first;
    const uint n = facing_shares(columns_level(scene, y, e->columns.levels - 1u), x, &first);
    const float fraction = math_clamp(fma(uv.x, (float)e->width, -(float)x), 0.0f, 0x1.fffffep-1f);
    const uint share_x = first + (uint)(fraction * (float)n);
    global const ushort* rows = facing_rows(scene, facing);
    const uint row = number_y >> (32u - PATCH_BITS), column = share_x >> (16u - PATCH_BITS);
    return facing_factor(facing_shares(rows, row, &first),
                         facing_shares(facing_columns(rows, row), column, &first));
}

#endif

/* Radiance from a world direction. *pdf: density with which light sampling draws this direction for a facing
 * (0: without), the pick included. */
TRIAD_FUNCTION Vec3 environment_radiance(const Scene* scene, Vec3 d, uint facing, float* pdf) {
    const Environment e = scene->frame->environment;
    (void)facing;
    *pdf = 0.0f;
#if TRIAD_ENVIRONMENT_MAP
    if (e.width != 0u) {
        const Vec2 uv = environment_uv(&e, d);
        const Vec3 radiance = environment_lookup(scene, &e, uv, pdf);
        *pdf = e.light != TRIAD_NONE ? *pdf * scene->lights[e.light].pick : 0.0f;
        if (facing != 0u && *pdf > 0.0f) *pdf *= facing_found(scene, facing, d, uv);
        return radiance;
    }
#endif
    return VEC3_OF(e.colour);
}

#endif
