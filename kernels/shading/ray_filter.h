/* Filter importance sampling (Ernst, Stamminger, Greiner 2006): rays start where a pixel filter is large, and
 * carry its sign. The filter is constant within a tap. */
#ifndef TRIAD_SHADING_RAY_FILTER_H
#define TRIAD_SHADING_RAY_FILTER_H

#include "common/vector.h"

/* Which of `size` intervals, whose upper bounds rise to 1, holds *u in [0, 1); *u becomes its place in it. */
TRIAD_FUNCTION uint ray_filter_find(global const float* bounds, uint size, float* u) {
    uint i = 0u;
    while (i + 1u < size && *u >= bounds[i]) ++i;
    const float low = i > 0u ? bounds[i - 1u] : 0.0f;
    const float width = bounds[i] - low, at = width > 0.0f ? (*u - low) / width : 0.5f;
    *u = at < 1.0f ? at : 0x1.fffffep-1f;
    return i;
}

/* Where a ray starts, in pixels from the upper left corner of its pixel (x, y) of the full picture, and what
 * its R, G, B count. A table: first tap across and down, bounds of rows, bounds of columns [row], weights
 * [row][column][R, G, B]. */
TRIAD_FUNCTION Vec2 ray_filter_sample(const Frame* frame, global const float* tables, uint x, uint y,
                                      uint bin, Vec2 u, Vec3* weight) {
    const RayFilterShape shape = frame->ray_filter;
    const uint of_cell = y % shape.cell[1] * shape.cell[0] + x % shape.cell[0];
    global const float* table =
        tables + (size_t)(of_cell * frame->bins[0] * frame->bins[1] + bin) * shape.table;
    global const float* rows = table + 2;
    global const float* columns = rows + shape.height;
    float across = u.x, down = u.y;
    const uint row = ray_filter_find(rows, shape.height, &down);
    const uint column = ray_filter_find(columns + row * shape.width, shape.width, &across);
    *weight = vec3_load(columns + shape.height * shape.width, row * shape.width + column);
    return vec2_make((table[0] + (float)column + across) / (float)shape.taps[0],
                     (table[1] + (float)row + down) / (float)shape.taps[1]);
}

#endif
