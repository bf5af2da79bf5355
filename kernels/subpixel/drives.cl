/* From planes of bins to planes of drives and to pixels: weighted sums of shifted rows. */
#include "common/language.h"

#include "subpixel/display.h"

/* Neighbouring cells that a work-item does at once. */
#ifndef DISPLAY_LANES
#define DISPLAY_LANES 16
#endif
/* Taps of each output; those that an output does not need have weight 0. */
#ifndef DISPLAY_TAPS
#define DISPLAY_TAPS 9
#endif

#if DISPLAY_LANES == 16
typedef float16 Lanes;
#define LANES_LOAD(p) vload16(0, p)
#define LANES_STORE(v, p) vstore16(v, 0, p)
#define LANES_INDICES ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#define LANES_WHERE(condition, v) select((Lanes)(0.0f), v, condition)
#elif DISPLAY_LANES == 1
typedef float Lanes;
#define LANES_LOAD(p) (*(p))
#define LANES_STORE(v, p) (*(p) = (v))
#define LANES_INDICES 0
#define LANES_WHERE(condition, v) ((condition) ? (v) : 0.0f)
#endif

/* Four sums side by side: shorter chains round less, and do not wait for each other. */
TRIAD_FUNCTION Lanes lanes_sum(global const float* in, global const int* offsets,
                               global const float* weights) {
    Lanes sums[4];
    for (uint i = 0u; i < 4u; ++i) sums[i] = (Lanes)(0.0f);
#pragma unroll
    for (uint tap = 0u; tap < DISPLAY_TAPS; ++tap)
        sums[tap & 3u] = fma((Lanes)(weights[tap]), LANES_LOAD(in + offsets[tap]), sums[tap & 3u]);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}
TRIAD_FUNCTION Lanes lanes_saturate(Lanes v) {
    return v > 0.0f ? (v < 1.0f ? v : (Lanes)(1.0f)) : (Lanes)(0.0f);
}

/* out[plane][row] = sum over taps of weight * in[row * in_step + offset], for rows of `runs` times
 * DISPLAY_LANES floats. offsets, weights: [phase][plane][tap]; row r of the slab is of phase (first_phase +
 * r) % phases. */
kernel void sum_taps(global const float* in, global float* out, global const int* offsets,
                     global const float* weights, uint runs, uint rows, uint planes, uint phases,
                     uint first_phase, uint in_first, uint in_step, uint out_first, uint out_stride,
                     uint out_plane) {
    const uint item = (uint)get_global_id(0);
    const uint run = item % runs, row = item / runs % rows, plane = item / runs / rows;
    if (plane >= planes) return;
    const size_t table = (size_t)((first_phase + row) % phases * planes + plane) * DISPLAY_TAPS;
    const size_t from = in_first + (size_t)row * in_step + run * DISPLAY_LANES;
    const size_t to = out_first + (size_t)plane * out_plane + (size_t)row * out_stride + run * DISPLAY_LANES;
    LANES_STORE(lanes_sum(in + from, offsets + table, weights + table), out + to);
}

/* Where a work-item of the refinement is, in planes of drives. */
typedef struct RefineRun {
    size_t at;
    size_t table; /* of offsets and weights */
    int inside;   /* cells of the run that are in the picture */
    int valid;
} RefineRun;

TRIAD_FUNCTION RefineRun refine_run(uint runs, uint rows, uint planes, uint phases, uint first_phase,
                                    uint first, uint stride, uint plane_floats, uint width, uint cell_x) {
    const uint item = (uint)get_global_id(0);
    const uint run = item % runs, row = item / runs % rows, plane = item / runs / rows;
    RefineRun r;
    r.valid = plane < planes;
    r.table = (size_t)((first_phase + row) % phases * planes + plane) * DISPLAY_TAPS;
    r.at = first + (size_t)plane * plane_floats + (size_t)row * stride + run * DISPLAY_LANES;
    r.inside = (int)((width + cell_x - 1u - plane % cell_x) / cell_x) - (int)(run * DISPLAY_LANES);
    return r;
}

/* The bounded refinement: least (d - d0)^T A (d - d0) with every drive in [0, 1], by accelerated projected
 * gradients (Beck and Teboulle 2009, "A fast iterative shrinkage-thresholding algorithm", FISTA with a
 * constant step). error = y - d0, 0 outside the picture: nothing is clipped there. */
kernel void refine_begin(global const float* asked, global float* shown, global float* error, uint runs,
                         uint rows, uint planes, uint first, uint stride, uint plane_floats, uint width,
                         uint cell_x) {
    const RefineRun r = refine_run(runs, rows, planes, 1u, 0u, first, stride, plane_floats, width, cell_x);
    if (!r.valid) return;
    const Lanes d0 = LANES_LOAD(asked + r.at), d = lanes_saturate(d0);
    LANES_STORE(d, shown + r.at);
    LANES_STORE(LANES_WHERE(LANES_INDICES < r.inside, d - d0), error + r.at);
}

/* weights hold the step; momentum is (t_k - 1) / t_(k + 1). */
kernel void refine_step(global const float* asked, global float* shown, global const float* error,
                        global float* next_error, global const int* offsets, global const float* weights,
                        float momentum, uint runs, uint rows, uint planes, uint phases, uint first_phase,
                        uint first, uint stride, uint plane_floats, uint width, uint cell_x) {
    const RefineRun r =
        refine_run(runs, rows, planes, phases, first_phase, first, stride, plane_floats, width, cell_x);
    if (!r.valid) return;
    const Lanes gradient = lanes_sum(error + r.at, offsets + r.table, weights + r.table);
    const Lanes d0 = LANES_LOAD(asked + r.at), before = LANES_LOAD(shown + r.at);
    const Lanes d = lanes_saturate(d0 + LANES_LOAD(error + r.at) - gradient);
    const Lanes ahead = fma((Lanes)(momentum), d - before, d);
    LANES_STORE(d, shown + r.at);
    LANES_STORE(LANES_WHERE(LANES_INDICES < r.inside, ahead - d0), next_error + r.at);
}

/* display: [pixel][R, G, B, alpha] of `rows` rows, display-linear in [0, 1] (TONE_NEVER: as it is). drives:
 * from the slab's first pixel on; the planes of a channel are its cell_x columns. */
kernel void gather_drives(global const DisplaySlab* slab, global const float* drives, global float* display,
                          uint rows, uint first, uint stride, uint plane_floats) {
    const uint item = (uint)get_global_id(0), x = item % slab->width, row = item / slab->width;
    if (row >= rows) return;
    const size_t at =
        first + (size_t)(x % slab->cell_x) * plane_floats + (size_t)row * stride + x / slab->cell_x;
    const size_t channel = (size_t)slab->cell_x * plane_floats;
    const float4 sum = (float4)(drives[at], drives[at + channel], drives[at + 2 * channel],
                                slab->channels == 4u ? drives[at + 3 * channel] : 1.0f);
    const float4 v = display_of_sum(slab, sum);
    vstore4(slab->order == TONE_NEVER
                ? v
                : (float4)(math_saturate(v.x), math_saturate(v.y), math_saturate(v.z), v.w),
            item, display);
}
