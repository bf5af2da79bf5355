/* The environment light: a lat-long map, sampled by rows and columns through integer CDFs. A row is drawn
 * with probability (difference of its bounds) / 2^32, a column of it with (its shares) / 2^16, exactly, so
 * that the pdf comes from the same integers: no row of probability zero is ever drawn, and no sum of floats
 * saturates. Within a cell, directions are uniform in solid angle. */
#ifndef TRIAD_SHADING_ENVIRONMENT_H
#define TRIAD_SHADING_ENVIRONMENT_H

#include "shading/scene.h"

/* Levels of the scene's trees at most, for programs that unroll the search: the host may know fewer. */
#ifndef TRIAD_CDF_LEVELS
#define TRIAD_CDF_LEVELS CDF_LEVELS
#endif

/* Which of eight bounds that do not fall is the last not beyond u; the first is not. */
TRIAD_FUNCTION uint cdf_below(global const uint* bounds, uint u) {
#if TRIAD_ITEM_LANES
    const ulong not_beyond = as_ulong(convert_char8(vload8(0, bounds) <= (uint8)(u)));
    return ((uint)popcount(not_beyond) >> 3) - 1u;
#else
    uint i = bounds[4] <= u ? 4u : 0u;
    i += bounds[i + 2u] <= u ? 2u : 0u;
    return i + (bounds[i + 1u] <= u ? 1u : 0u);
#endif
}

/* The interval of a tree (CdfShape) that holds u, and its bounds. */
TRIAD_FUNCTION uint cdf_search(global const CdfShape* shape, global const uint* tree, uint u, uint* lo,
                               uint* hi) {
    u = u == 0xffffffffu ? 0xfffffffeu : u;
    const uint levels = shape->levels;
    uint i = 0u;
    uint first = 0u;
    TRIAD_FOR(level, levels, TRIAD_CDF_LEVELS) {
        first = shape->first[level];
        i = 8u * i + cdf_below(tree + first + 8u * i, u);
    }
    *lo = tree[first + i], *hi = tree[first + i + 1u];
    return i;
}

/* The interval of a tree that holds u; where in it, in [0, 1), and its probability. */
TRIAD_FUNCTION uint cdf_find(global const CdfShape* shape, global const uint* tree, uint u, float* fraction,
                             float* probability) {
    uint lo, hi;
    const uint i = cdf_search(shape, tree, u, &lo, &hi);
    const float width = (float)(hi - lo);
    const float f = ((float)(u - lo) + 0.5f) / width;
    *fraction = f < 0x1.fffffep-1f ? f : 0x1.fffffep-1f;
    *probability = width * 0x1.0p-32f;
    return i;
}

#if TRIAD_ENVIRONMENT_MAP

/* Map coordinates in [0, 1] of a world direction. */
TRIAD_FUNCTION Vec2 environment_uv(const Environment* e, Vec3 d) {
    const float x = e->rotate_cos * d.x + e->rotate_sin * d.z, z = e->rotate_cos * d.z - e->rotate_sin * d.x;
    return vec2_make(fma(math_atan2(z, x), 0.15915494309f, 0.5f),
                     math_acos(math_clamp(d.y, -1.0f, 1.0f)) * 0.31830988618f);
}

/* RGB, and in w the density of drawing a direction in this texel. */
TRIAD_FUNCTION Vec4 environment_texel(const Scene* scene, const Environment* e, int x, int y) {
    const size_t i = (size_t)(y * (int)e->width + x);
    if (e->format == ENVIRONMENT_FLOAT) {
        global const uint* t = scene->env_texels + 4u * i;
        return vec4_make(as_float(t[0]), as_float(t[1]), as_float(t[2]), as_float(t[3]));
    }
    const uint rgbe = scene->env_texels[2u * i], density = scene->env_texels[2u * i + 1u];
    const float unit = as_float((rgbe & 0xff000000u) >> 1);
    return vec4_make((float)(rgbe & 0xffu) * unit, (float)(rgbe >> 8 & 0xffu) * unit,
                     (float)(rgbe >> 16 & 0xffu) * unit, as_float(density));
}

/* Radiance at map coordinates, bilinear; *pdf: solid-angle density of environment_sample there. */
TRIAD_FUNCTION_PER_CALL Vec3 environment_lookup(const Scene* scene, const Environment* e, Vec2 uv,
                                                float* pdf) {
    const float x = uv.x * (float)e->width - 0.5f, y = uv.y * (float)e->height - 0.5f;
    const float fx = math_floor(x), fy = math_floor(y);
    const int w = (int)e->width, h = (int)e->height;
    int x0 = (int)fx, x1 = x0 + 1;
    /* clamped for directions that are no numbers */
    x0 = math_clamp_int(x0 < 0 ? x0 + w : x0 >= w ? x0 - w : x0, 0, w - 1);
    x1 = math_clamp_int(x1 < 0 ? x1 + w : x1 >= w ? x1 - w : x1, 0, w - 1);
    const int y0 = math_clamp_int((int)fy, 0, h - 1), y1 = math_clamp_int((int)fy + 1, 0, h - 1);
    const float ax = x - fx, ay = y - fy;
    const Vec4 a = environment_texel(scene, e, x0, y0), b = environment_texel(scene, e, x1, y0);
    const Vec4 c = environment_texel(scene, e, x0, y1), d = environment_texel(scene, e, x1, y1);
    const Vec4 top = vec4_blend(a, b, ax), bottom = vec4_blend(c, d, ax);
    /* the density is constant over a texel: that of the nearest one */
    *pdf = ay < 0.5f ? (ax < 0.5f ? a.w : b.w) : (ax < 0.5f ? c.w : d.w);
    return vec3_scale(vec4_xyz(vec4_blend(top, bottom, ay)), e->strength);
}

/* Asks for the texels of environment_lookup. */
TRIAD_FUNCTION void environment_prefetch_texels(const Scene* scene, const Environment* e, Vec2 uv) {
    const uint x = (uint)(uv.x * (float)e->width), y = (uint)(uv.y * (float)e->height);
    const uint words = e->format == ENVIRONMENT_FLOAT ? 4u : 2u;
    global const uint* texel = scene->env_texels + words * ((size_t)y * e->width + x);
    TRIAD_PREFETCH(texel);
    TRIAD_PREFETCH(texel + words * e->width);
}

/* How many of sixteen shares, which do not fall, are below `share`; the last is not. */
TRIAD_FUNCTION uint shares_below(global const ushort* entries, ushort share) {
#if TRIAD_ITEM_LANES
    const ulong2 below = as_ulong2(convert_char16(vload16(0, entries) < (ushort16)(share)));
    return (uint)(popcount(below.x) + popcount(below.y)) >> 3;
#else
    uint i = entries[7] < share ? 8u : 0u;
    i += entries[i + 3u] < share ? 4u : 0u;
    i += entries[i + 1u] < share ? 2u : 0u;
    return i + (entries[i] < share ? 1u : 0u);
#endif
}
/* The same of COLUMNS_FANOUT. */
TRIAD_FUNCTION uint columns_below(global const ushort* entries, ushort share) {
#if TRIAD_ITEM_LANES
    return shares_below(entries, share) + shares_below(entries + 16, share);
#else
    const uint first = entries[15] < share ? 16u : 0u;
    return first + shares_below(entries + first, share);
#endif
}

TRIAD_FUNCTION global const ushort* columns_level(const Scene* scene, uint row, uint level) {
    global const ColumnsShape* shape = &scene->frame->environment.columns;
    return scene->env_columns + shape->first[level] + row * shape->stride[level];
}

/* The child that holds the share u / 2^16, after some levels of a row's tree. */
TRIAD_FUNCTION uint columns_descend(const Scene* scene, uint row, uint u, uint levels) {
    uint i = 0u;
    TRIAD_FOR(level, levels, COLUMNS_LEVELS)
    i = COLUMNS_FANOUT * i +
        columns_below(columns_level(scene, row, level) + COLUMNS_FANOUT * i, (ushort)(u >> 16));
    return i;
}

/* The row that u draws. */
TRIAD_FUNCTION uint environment_row(const Scene* scene, uint u, float* fraction) {
    float unused;
    return cdf_find(&scene->frame->environment.rows, scene->env_rows, u, fraction, &unused);
}

/* Draws a direction from two uniform integers; returns its map coordinates. */
TRIAD_FUNCTION Vec3 environment_sample(const Scene* scene, const Environment* e, UVec2 u, Vec2* uv) {
    float row_fraction;
    const uint row = environment_row(scene, u.y, &row_fraction);
    const float c0 = scene->env_cosines[row], c1 = scene->env_cosines[row + 1u];
    const float y = c0 + (c1 - c0) * row_fraction;
    const uint column = columns_descend(scene, row, u.x, e->columns.levels);
    global const ushort* last = columns_level(scene, row, e->columns.levels - 1u);
    const uint lo = column == 0u ? 0u : last[column - 1u] + 1u, hi = last[column] + 1u;
    const float x_fraction = ((float)(u.x - (lo << 16)) + 0.5f) * 0x1.0p-16f / (float)(hi - lo);
    uv->x = ((float)column + math_min(x_fraction, 0x1.fffffep-1f)) / (float)e->width;
    uv->y = math_acos(math_clamp(y, -1.0f, 1.0f)) * 0.31830988618f;
    const float s = sqrt((1.0f - y) * (1.0f + y));
    float sine, cosine;
    math_sincos_turns(uv->x - 0.5f, &sine, &cosine);
    const float x = s * cosine, z = s * sine;
    return vec3_make(e->rotate_cos * x - e->rotate_sin * z, y, e->rotate_cos * z + e->rotate_sin * x);
}

#endif

#endif
