/* The first stage from bins to drives: radiance, exposure and tone map of every bin, into planes. */
#include "common/language.h"

#include "subpixel/display.h"
#include "subpixel/noise.h"

/* Cells that a work-item fills, one after the other: 16 for a CPU's vectors, 1 where neighbours in memory are
 * to be neighbours in a work-group. */
#ifndef DISPLAY_LANES
#define DISPLAY_LANES 16
#endif

/* What a work-item fills: row `row` of the planes of column `column` of the cell, from cell `cell` on. */
typedef struct BinRun {
    uint row, column, cell;
    uint source_row;     /* row of bins of the picture */
    uint pixel_x, bin_x; /* of the column: pixel of the cell, bin of the pixel */
    size_t at;           /* in a plane of channel 0 */
} BinRun;

TRIAD_FUNCTION BinRun bin_run(global const DisplaySlab* slab, uint item) {
    const uint runs = slab->stride / DISPLAY_LANES, columns = slab->cell_x * slab->bins[0];
    BinRun run;
    run.cell = item % runs * DISPLAY_LANES;
    run.column = item / runs % columns;
    run.row = item / runs / columns;
    run.source_row = display_reflect(slab->first_row + (int)run.row, slab->rows);
    run.pixel_x = run.column / slab->bins[0];
    run.bin_x = run.column % slab->bins[0];
    run.at = (size_t)run.column * slab->plane + (size_t)run.row * slab->stride + run.cell;
    return run;
}

/* Column of bins of the picture that lane `lane` of the run takes: its pixel, and the bin of that. Divisions
 * only beyond the edges. */
TRIAD_FUNCTION UVec2 bin_column(global const DisplaySlab* slab, const BinRun* run, uint lane) {
    const int cell = (int)(run->cell + lane) - (int)slab->left, bins = (int)slab->bins[0];
    const int column = cell * (int)slab->cell_x * bins + (int)run->column;
    if (column >= 0 && column < (int)slab->columns)
        return uvec2_make((uint)cell * slab->cell_x + run->pixel_x, run->bin_x);
    const uint inside = display_reflect(column, slab->columns);
    return uvec2_make(inside / (uint)bins, inside % (uint)bins);
}

TRIAD_FUNCTION void bin_store(global const DisplaySlab* slab, global float* planes, const BinRun* run,
                              uint lane, Vec4 v) {
    const size_t channel = (size_t)slab->cell_x * slab->bins[0] * slab->plane;
    global float* to = planes + run->at + lane;
    to[0] = v.x;
    to[channel] = v.y;
    to[2 * channel] = v.z;
    if (slab->channels == 4u) to[3 * channel] = v.w;
}

/* A bin of a film's pixel, as radiance times exposure, and alpha. sums: [pixel][bin][R, G, B, alpha] in units
 * of slab->unit; samples: per pixel, over all bins, spread evenly over them. */
TRIAD_FUNCTION Vec4 film_bin(global const DisplaySlab* slab, global const long* sums,
                             global const uint* samples, size_t pixel, uint bin) {
    const uint bins = slab->bins[0] * slab->bins[1], count = samples[pixel];
    const float unit = count > 0u ? slab->unit * (float)bins / (float)count : 0.0f;
    sums += 4 * (pixel * bins + bin);
    const Vec3 v = vec3_make((float)sums[0] * unit, (float)sums[1] * unit, (float)sums[2] * unit);
    return vec3_with(vec3_scale(v, slab->exposure), (float)sums[3] * unit);
}

kernel void map_film(global const DisplaySlab* slab, global const long* sums, global const uint* samples,
                     global float* planes, uint items) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    const BinRun run = bin_run(slab, item);
    const size_t row = (size_t)(run.source_row / slab->bins[1] - slab->source_row) * slab->width;
    const uint first_bin = run.source_row % slab->bins[1] * slab->bins[0];
    for (uint lane = 0u; lane < DISPLAY_LANES; ++lane) {
        const UVec2 column = bin_column(slab, &run, lane);
        bin_store(slab, planes, &run, lane,
                  display_of_bin(slab, film_bin(slab, sums, samples, row + column.x, first_bin + column.y)));
    }
}

/* The same, where bins differ by noise as well: each is the mixture that weigh_noise found. */
kernel void map_noisy_film(global const DisplaySlab* slab, global const long* sums,
                           global const uint* samples, global float* planes, uint items,
                           global const float* means) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    const BinRun run = bin_run(slab, item);
    const size_t row = (size_t)(run.source_row / slab->bins[1] - slab->source_row) * slab->width;
    const uint first_bin = run.source_row % slab->bins[1] * slab->bins[0];
    for (uint lane = 0u; lane < DISPLAY_LANES; ++lane) {
        const UVec2 column = bin_column(slab, &run, lane);
        const size_t pixel = row + column.x;
        bin_store(slab, planes, &run, lane,
                  noise_display(slab, film_bin(slab, sums, samples, pixel, first_bin + column.y),
                                means + pixel * NOISE_RECORD));
    }
}

/* The mean of every pixel of `rows` rows of the film's buffers, into its record. */
kernel void average_film(global const DisplaySlab* slab, global const long* sums, global const uint* samples,
                         global float* means, uint rows) {
    const uint pixel = (uint)get_global_id(0), bins = slab->bins[0] * slab->bins[1];
    if (pixel >= rows * slab->width) return;
    Vec4 mean = vec4_splat(0.0f);
    for (uint bin = 0u; bin < bins; ++bin) mean = vec4_add(mean, film_bin(slab, sums, samples, pixel, bin));
    vec4_store(vec4_scale(mean, 1.0f / (float)bins), means + (size_t)pixel * NOISE_RECORD, 0);
}

/* What else noise_display needs to know of them. A pixel's bins and those around it tell noise from
 * structure: what is structure is alike in neighbouring bins, and in both halves of the samples. The tangent
 * touches where a filter for noise sees the pixel's mean among those around it (Lee 1980, "Digital Image
 * Enhancement and Noise Filtering by Use of Local Statistics"). first, second, weights: HalfMeans
 * (host/scene/film.h), if halves_known: what a missing buffer looks like to a kernel is the driver's affair.
 */
kernel void weigh_noise(global const DisplaySlab* slab, global const long* sums, global const uint* samples,
                        global float* means, uint rows, global const float* first, global const float* second,
                        global const float* weights, uint halves_known) {
    const uint pixel = (uint)get_global_id(0), x = pixel % slab->width, y = pixel / slab->width;
    if (y >= rows) return;
    const uint bins_x = slab->bins[0], bins_y = slab->bins[1], bins = bins_x * bins_y;
    float above[FILM_MOST_BINS + 2];
    Vec4 chess[2] = {vec4_splat(0.0f), vec4_splat(0.0f)}; /* its own bins, as on a chessboard */
    NoiseSums noise = {0.0f, 0.0f, 0.0f, 0u, 0u};
    for (int v = -1; v <= (int)bins_y; ++v) {
        float left = 0.0f;
        for (int u = -1; u <= (int)bins_x; ++u) {
            const uint column = display_reflect((int)(x * bins_x) + u, slab->columns);
            const uint row = display_reflect((int)((slab->source_row + y) * bins_y) + v, slab->rows);
            const uint at =
                math_min_uint(row / bins_y - math_min_uint(slab->source_row, row / bins_y), rows - 1u);
            const Vec4 bin = film_bin(slab, sums, samples, (size_t)at * slab->width + column / bins_x,
                                      row % bins_y * bins_x + column % bins_x);
            const float value = noise_value(bin);
            if (u >= 0 && u < (int)bins_x && v >= 0 && v < (int)bins_y)
                chess[(u ^ v) & 1] = vec4_add(chess[(u ^ v) & 1], bin);
            noise_add(&noise, value);
            if (u >= 0) noise_add_pair(&noise, value, left);
            if (v >= 0) noise_add_pair(&noise, value, above[u + 1]);
            above[u + 1] = left = value;
        }
    }
    const float rays = (float)(samples[pixel] > bins ? samples[pixel] : bins) / (float)bins;
    NoiseSums pixels = {0.0f, 0.0f, 0.0f, 0u, 0u};
    Vec4 around = vec4_splat(0.0f);
    float halves = 0.0f;
    for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) {
            const uint row = display_reflect((int)(slab->source_row + y) + v, slab->height);
            const uint at =
                math_min_uint(row - math_min_uint(slab->source_row, row), rows - 1u) * slab->width +
                display_reflect((int)x + u, slab->width);
            const Vec4 mean = vec4_load(means + (size_t)at * NOISE_RECORD, 0);
            noise_add(&pixels, noise_value(mean));
            around = vec4_fma_scale(1.0f / 9.0f, mean, around);
            if (halves_known)
                halves += noise_of_halves(vec3_scale(vec3_load(first, at), slab->exposure),
                                          vec3_scale(vec3_load(second, at), slab->exposure), weights[at],
                                          (float)bins) *
                          (1.0f / 9.0f);
        }
    global float* to = means + (size_t)pixel * NOISE_RECORD;
    float variance;
    const float share = noise_share(&noise, rays, halves, &variance);
    /* means of bins vary by noise as well, but by the number of bins less */
    const float differ = noise_variance(&pixels),
                smooth = differ > 1e-9f ? math_saturate(share * variance / ((float)bins * differ)) : 0.0f;
    const Vec4 mean = vec4_load(to, 0), point = vec4_mix(mean, around, smooth);
    vec4_store(point, to, 1);
    vec4_store(display_of_bin(slab, point), to, 2);
    to[NOISE_SHARE] = share;
    Vec3 lost = vec3_splat(0.0f);
    if (halves_known) {
        lost = noise_lost(slab, vec3_scale(vec3_load(first, pixel), slab->exposure),
                          vec3_scale(vec3_load(second, pixel), slab->exposure), mean.w,
                          math_square(weights[pixel]));
    } else if (bins > 1u) {
        /* of bins, structure is to be left out as where they are evened out */
        const float a = (float)((bins + 1u) / 2u), b = (float)(bins / 2u);
        lost = noise_lost(slab, vec3_scale(vec4_xyz(chess[0]), 1.0f / a),
                          vec3_scale(vec4_xyz(chess[1]), 1.0f / b), mean.w,
                          share * share * a * b / math_square(a + b));
    }
    vec3_store(lost, to + NOISE_LOST, 0);
    /* If a point of variance A and a mean of variance B have the covariance C, the tangent at the point loses
     * by 2 C - A at the mean, not by B: (1 - s) of the mean and s of nine like it make that 1 - 8/9 s^2 of B.
     */
    to[NOISE_LEFT] = fma(-8.0f / 9.0f * smooth, smooth, 1.0f);
}

/* What noise takes, as the pixels around tell as well: one alone hardly knows it, and it changes slowly. */
kernel void mend_noise(global const DisplaySlab* slab, global float* means, uint rows) {
    const uint pixel = (uint)get_global_id(0), x = pixel % slab->width, y = pixel / slab->width;
    if (y >= rows) return;
    Vec3 lost = vec3_splat(0.0f);
    for (int v = -NOISE_REACH; v <= NOISE_REACH; ++v) {
        const uint row = display_reflect((int)(slab->source_row + y) + v, slab->height);
        const uint at = math_min_uint(row - math_min_uint(slab->source_row, row), rows - 1u) * slab->width;
        for (int u = -NOISE_REACH; u <= NOISE_REACH; ++u) {
            const size_t near = at + display_reflect((int)x + u, slab->width);
            lost = vec3_add(vec3_load(means + near * NOISE_RECORD + NOISE_LOST, 0), lost);
        }
    }
    global float* to = means + (size_t)pixel * NOISE_RECORD;
    const int side = 2 * NOISE_REACH + 1;
    vec3_store(vec3_scale(lost, to[NOISE_LEFT] / (float)(side * side)), to + NOISE_MEND, 0);
}

/* image: [row][column][R, G, B, alpha], colour associated; of encoded ones not, as in their files. */
kernel void map_image(global const DisplaySlab* slab, global const float* image, global float* planes,
                      uint items) {
    const uint item = (uint)get_global_id(0);
    if (item >= items) return;
    const BinRun run = bin_run(slab, item);
    const size_t row = (size_t)(run.source_row - slab->source_row) * slab->columns;
    for (uint lane = 0u; lane < DISPLAY_LANES; ++lane) {
        const UVec2 column = bin_column(slab, &run, lane);
        Vec4 v = vec4_load(image, row + column.x * slab->bins[0] + column.y);
        if (slab->encoded)
            v = vec3_with(vec3_scale(srgb_decode3(vec4_xyz(v)), v.w), v.w);
        else
            v = vec3_with(vec3_scale(vec4_xyz(v), slab->exposure), v.w);
        bin_store(slab, planes, &run, lane, display_of_bin(slab, v));
    }
}
