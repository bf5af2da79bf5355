/* The first stage from bins to drives: radiance, exposure and tone map of every bin, into planes. */
#include "common/language.h"

#include "subpixel/display.h"

/* Cells that a work-item fills, one after the other: 16 for a CPU's vectors, 1 where neighbours in memory are
 * to be neighbours in a work-group. */
#ifndef DISPLAY_LANES
#define DISPLAY_LANES 16
#endif

/* What a work-item fills: row `row` of the planes of column `column` of the cell, from cell `cell` on. */
typedef struct BinRun {
    uint row, column, cell;
    uint source_row; /* row of bins of the picture */
    size_t at;       /* in a plane of channel 0 */
} BinRun;

TRIAD_FUNCTION BinRun bin_run(global const DisplaySlab* slab, uint item) {
    const uint runs = slab->stride / DISPLAY_LANES, columns = slab->cell_x * slab->bins[0];
    BinRun run;
    run.cell = item % runs * DISPLAY_LANES;
    run.column = item / runs % columns;
    run.row = item / runs / columns;
    run.source_row = display_reflect(slab->first_row + (int)run.row, slab->rows);
    run.at = (size_t)run.column * slab->plane + (size_t)run.row * slab->stride + run.cell;
    return run;
}

/* Column of bins of the picture that lane `lane` of the run takes. */
TRIAD_FUNCTION uint bin_column(global const DisplaySlab* slab, const BinRun* run, uint lane) {
    const int cell = (int)(run->cell + lane) - (int)slab->left;
    return display_reflect(cell * (int)(slab->cell_x * slab->bins[0]) + (int)run->column, slab->columns);
}

TRIAD_FUNCTION void bin_store(global const DisplaySlab* slab, global float* planes, const BinRun* run,
                              uint lane, float4 v) {
    const size_t channel = (size_t)slab->cell_x * slab->bins[0] * slab->plane;
    global float* to = planes + run->at + lane;
    to[0] = v.x;
    to[channel] = v.y;
    to[2 * channel] = v.z;
    if (slab->channels == 4u) to[3 * channel] = v.w;
}

/* sums: [pixel][bin][R, G, B, alpha] in units of slab->unit; samples: per pixel, over all bins, spread evenly
 * over them. */
kernel void map_film(global const DisplaySlab* slab, global const long* sums, global const uint* samples,
                     global float* planes, uint items) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    const BinRun run = bin_run(slab, item);
    const uint bins_x = slab->bins[0], bins = bins_x * slab->bins[1];
    const size_t row = (size_t)(run.source_row / slab->bins[1] - slab->source_row) * slab->width;
    const uint first_bin = run.source_row % slab->bins[1] * bins_x;
    for (uint lane = 0u; lane < DISPLAY_LANES; ++lane) {
        const uint column = bin_column(slab, &run, lane);
        const size_t pixel = row + column / bins_x;
        const uint count = samples[pixel];
        const float unit = count > 0u ? slab->unit * convert_float(bins) / convert_float(count) : 0.0f;
        float4 v = convert_float4(vload4(pixel * bins + first_bin + column % bins_x, sums)) * unit;
        v.xyz *= slab->exposure;
        bin_store(slab, planes, &run, lane, display_of_bin(slab, v));
    }
}

/* image: [row][column][R, G, B, alpha], colour associated; of encoded ones not, as in their files. */
kernel void map_image(global const DisplaySlab* slab, global const float* image, global float* planes,
                      uint items) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    const BinRun run = bin_run(slab, item);
    const size_t row = (size_t)(run.source_row - slab->source_row) * slab->columns;
    for (uint lane = 0u; lane < DISPLAY_LANES; ++lane) {
        float4 v = vload4(row + bin_column(slab, &run, lane), image);
        if (slab->encoded)
            v.xyz = srgb_decode3(v.xyz) * v.w;
        else
            v.xyz *= slab->exposure;
        bin_store(slab, planes, &run, lane, display_of_bin(slab, v));
    }
}
