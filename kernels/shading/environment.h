/* The environment light: a lat-long map, sampled by rows and columns through integer CDFs. A cell is drawn
 * with probability (difference of its bounds) / 2^32 exactly, so that the pdf comes from the same integers:
 * no cell of probability zero is ever drawn, and no sum of floats saturates. Within a cell, directions are
 * uniform in solid angle. */
#ifndef TRIAD_SHADING_ENVIRONMENT_H
#define TRIAD_SHADING_ENVIRONMENT_H

#include "shading/scene.h"

/* The interval [cdf[i], cdf[i + 1]) that holds u: cdf[0] = 0, cdf[n] = 2^32 - 1, n >= 1. Also where in it, in
 * [0, 1). */
TRIAD_FUNCTION uint cdf_find(global const uint* cdf, uint n, uint u, float* fraction) {
    u = u == 0xffffffffu ? 0xfffffffeu : u;
    uint lo = 0u, hi = n;
    while (hi - lo > 1u) {
        const uint middle = (lo + hi) >> 1;
        const int right = cdf[middle] <= u;
        lo = right ? middle : lo;
        hi = right ? hi : middle;
    }
    *fraction = ((float)(u - cdf[lo]) + 0.5f) / (float)(cdf[lo + 1u] - cdf[lo]);
    *fraction = *fraction < 0x1.fffffep-1f ? *fraction : 0x1.fffffep-1f;
    return lo;
}

TRIAD_FUNCTION float cdf_probability(global const uint* cdf, uint i) {
    return (float)(cdf[i + 1u] - cdf[i]) * 0x1.0p-32f;
}

#if TRIAD_ENVIRONMENT_MAP

/* Map coordinates in [0, 1] of a world direction. */
TRIAD_FUNCTION float2 environment_uv(const Environment* e, float3 d) {
    const float x = e->rotate_cos * d.x + e->rotate_sin * d.z, z = e->rotate_cos * d.z - e->rotate_sin * d.x;
    return (float2)(fma(math_atan2(z, x), 0.15915494309f, 0.5f),
                    math_acos(clamp(d.y, -1.0f, 1.0f)) * 0.31830988618f);
}

TRIAD_FUNCTION float3 environment_lookup(const Scene* scene, const Environment* e, float2 uv) {
    const float x = uv.x * (float)e->width - 0.5f, y = uv.y * (float)e->height - 0.5f;
    const float fx = math_floor(x), fy = math_floor(y);
    const int w = (int)e->width, h = (int)e->height;
    int x0 = (int)fx, x1 = x0 + 1;
    x0 = x0 < 0 ? x0 + w : x0 >= w ? x0 - w : x0;
    x1 = x1 < 0 ? x1 + w : x1 >= w ? x1 - w : x1;
    const int y0 = clamp((int)fy, 0, h - 1), y1 = clamp((int)fy + 1, 0, h - 1);
    const float ax = x - fx, ay = y - fy;
    const float3 a = load3(scene->env_texels, (uint)(y0 * w + x0)),
                 b = load3(scene->env_texels, (uint)(y0 * w + x1));
    const float3 c = load3(scene->env_texels, (uint)(y1 * w + x0)),
                 d = load3(scene->env_texels, (uint)(y1 * w + x1));
    const float3 top = a + (b - a) * ax, bottom = c + (d - c) * ax;
    return (top + (bottom - top) * ay) * e->strength;
}

/* Solid-angle density of environment_sample at map coordinates, without the probability of picking this
 * light. */
TRIAD_FUNCTION float environment_pdf(const Scene* scene, const Environment* e, float2 uv) {
    const uint column = min((uint)(uv.x * (float)e->width), e->width - 1u);
    const uint row = min((uint)(uv.y * (float)e->height), e->height - 1u);
    const float p = cdf_probability(scene->env_rows, row) *
                    cdf_probability(scene->env_columns + row * (e->width + 1u), column);
    return p * (float)e->width / (6.28318530718f * (scene->env_cosines[row] - scene->env_cosines[row + 1u]));
}

/* Draws a direction from two uniform integers; returns its map coordinates too. */
TRIAD_FUNCTION float3 environment_sample(const Scene* scene, const Environment* e, uint2 u, float2* uv,
                                         float* pdf) {
    float fraction_row, fraction_column;
    const uint row = cdf_find(scene->env_rows, e->height, u.y, &fraction_row);
    global const uint* columns = scene->env_columns + row * (e->width + 1u);
    const uint column = cdf_find(columns, e->width, u.x, &fraction_column);
    const float c0 = scene->env_cosines[row], c1 = scene->env_cosines[row + 1u];
    const float y = c0 + (c1 - c0) * fraction_row;
    uv->x = ((float)column + fraction_column) / (float)e->width;
    uv->y = math_acos(clamp(y, -1.0f, 1.0f)) * 0.31830988618f;
    *pdf = cdf_probability(scene->env_rows, row) * cdf_probability(columns, column) * (float)e->width /
           (6.28318530718f * (c0 - c1));
    const float s = sqrt((1.0f - y) * (1.0f + y));
    float sine, cosine;
    math_sincos_turns(uv->x - 0.5f, &sine, &cosine);
    const float x = s * cosine, z = s * sine;
    return (float3)(e->rotate_cos * x - e->rotate_sin * z, y, e->rotate_cos * z + e->rotate_sin * x);
}

#endif

/* Radiance from a world direction. *pdf: density with which light sampling draws this direction, the pick
 * included. */
TRIAD_FUNCTION float3 environment_radiance(const Scene* scene, float3 d, float* pdf) {
    const Environment e = scene->frame->environment;
    *pdf = 0.0f;
#if TRIAD_ENVIRONMENT_MAP
    if (e.width != 0u) {
        const float2 uv = environment_uv(&e, d);
        if (e.light != TRIAD_NONE) *pdf = scene->lights[e.light].pick * environment_pdf(scene, &e, uv);
        return environment_lookup(scene, &e, uv);
    }
#endif
    return (float3)(e.colour[0], e.colour[1], e.colour[2]);
}

#endif
