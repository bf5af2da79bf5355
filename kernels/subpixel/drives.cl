/* From planes of bins to planes of drives and to pixels: weighted sums of shifted rows. */
#include "common/language.h"

#include "subpixel/display.h"

/* Neighbouring cells that a work-item does at once: as many as a CPU's vectors hold; 1 where neighbours in
 * memory are to be neighbours in a work-group. */
#ifndef DISPLAY_LANES
#define DISPLAY_LANES 16
#endif
/* Rows that a work-item does with one reading of the taps. On GPUs the tables cost as many loads as the
 * bins. */
#ifndef DISPLAY_ROWS
#define DISPLAY_ROWS 1
#endif
/* Taps of each output; those that an output does not need have weight 0. */
#ifndef DISPLAY_TAPS
#define DISPLAY_TAPS 9
#endif

#define LANES DISPLAY_LANES
#include "common/lanes.h"

/* What a work-item does: DISPLAY_ROWS rows of a plane of outputs, from `row` on in steps of `step` (the
 * phases: rows of one phase share their taps), each for DISPLAY_LANES cells from the run-th such group on. */
typedef struct TapRun {
    uint run, row, step, rows, plane;
    size_t table; /* of offsets and weights: [phase][plane][tap] */
} TapRun;

/* groups: the work-items for all rows, phases * ceil(rows / (phases * DISPLAY_ROWS)). Row r of the slab is of
 * phase (first_phase + r) % phases; first_phase < phases. */
TRIAD_FUNCTION TapRun tap_run(uint runs, uint rows, uint groups, uint phases, uint first_phase, uint planes) {
    const uint item = (uint)get_global_id(0), line = item / runs;
    TapRun r;
    r.run = item - line * runs;
    r.plane = line / groups;
    const uint group = line - r.plane * groups, of = group / phases, phase = group - of * phases;
    r.row = of * phases * DISPLAY_ROWS + phase;
    r.step = phases;
    r.rows = r.plane < planes ? rows : 0u;
    const uint turned = first_phase + phase;
    r.table = (size_t)((turned < phases ? turned : turned - phases) * planes + r.plane) * DISPLAY_TAPS;
    return r;
}
TRIAD_FUNCTION int tap_has_row(const TapRun* r, uint k) { return r->row + k * r->step < r->rows; }
/* The k-th row; beyond the last one that again, which may be read. */
TRIAD_FUNCTION size_t tap_row(const TapRun* r, uint k) {
    return math_min_uint(r->row + k * r->step, r->rows - 1u);
}

/* The tap-th products of all rows. */
TRIAD_FUNCTION void lanes_add(global const float* const* in, int offset, float weight, Lanes* sums) {
#pragma unroll
    for (uint k = 0u; k < DISPLAY_ROWS; ++k)
        sums[k] = fma((Lanes)(weight), LANES_LOAD(in[k] + offset), sums[k]);
}

/* Sums of all rows. Four side by side for each: shorter chains round less, and do not wait for each other.
 * Unrolled further for vectors alone: a GPU's compiler would read everything first and run out of registers.
 */
TRIAD_FUNCTION void lanes_sum(global const float* const* in, global const int* offsets,
                              global const float* weights, Lanes* out) {
    Lanes sums[4][DISPLAY_ROWS];
    for (uint i = 0u; i < 4u; ++i)
        for (uint k = 0u; k < DISPLAY_ROWS; ++k) sums[i][k] = (Lanes)(0.0f);
#if DISPLAY_LANES > 1
#pragma unroll
#endif
    for (uint tap = 0u; tap + 4u <= DISPLAY_TAPS; tap += 4u)
#pragma unroll
        for (uint i = 0u; i < 4u; ++i) lanes_add(in, offsets[tap + i], weights[tap + i], sums[i]);
#pragma unroll
    for (uint i = 0u; i < DISPLAY_TAPS % 4u; ++i) {
        const uint tap = DISPLAY_TAPS / 4u * 4u + i;
        lanes_add(in, offsets[tap], weights[tap], sums[i]);
    }
    for (uint k = 0u; k < DISPLAY_ROWS; ++k) out[k] = (sums[0][k] + sums[1][k]) + (sums[2][k] + sums[3][k]);
}
TRIAD_FUNCTION Lanes lanes_saturate(Lanes v) {
    return v > 0.0f ? (v < 1.0f ? v : (Lanes)(1.0f)) : (Lanes)(0.0f);
}

/* out[plane][row] = sum over taps of weight * in[row * in_step + offset], for rows of `runs` times
 * DISPLAY_LANES floats. */
kernel void sum_taps(global const float* in, global float* out, global const int* offsets,
                     global const float* weights, uint runs, uint rows, uint groups, uint planes, uint phases,
                     uint first_phase, uint in_first, uint in_step, uint out_first, uint out_stride,
                     uint out_plane) {
    const TapRun r = tap_run(runs, rows, groups, phases, first_phase, planes);
    if (!tap_has_row(&r, 0u)) return;
    global const float* from[DISPLAY_ROWS];
    for (uint k = 0u; k < DISPLAY_ROWS; ++k)
        from[k] = in + (in_first + tap_row(&r, k) * in_step + r.run * DISPLAY_LANES);
    Lanes sums[DISPLAY_ROWS];
    lanes_sum(from, offsets + r.table, weights + r.table, sums);
    global float* to = out + (out_first + (size_t)r.plane * out_plane + r.run * DISPLAY_LANES);
    for (uint k = 0u; k < DISPLAY_ROWS; ++k)
        if (tap_has_row(&r, k)) LANES_STORE(sums[k], to + tap_row(&r, k) * out_stride);
}

/* Where a row of a refinement's run is, in planes of drives. */
TRIAD_FUNCTION size_t refine_at(const TapRun* r, uint k, uint first, uint stride, uint plane_floats) {
    return first + (size_t)r->plane * plane_floats + tap_row(r, k) * stride + r->run * DISPLAY_LANES;
}
/* Cells of the run that are in the picture. */
TRIAD_FUNCTION int refine_inside(const TapRun* r, uint width, uint cell_x) {
    return (int)((width + cell_x - 1u - r->plane % cell_x) / cell_x) - (int)(r->run * DISPLAY_LANES);
}

/* The bounded refinement: least (d - d0)^T A (d - d0) with every drive in [0, 1], by the splitting of Douglas
 * and Rachford (Lions and Mercier 1979, "Splitting Algorithms for the Sum of Two Nonlinear Operators"):
 *     w = 2 clip(v) - v - d0,    v <- v - clip(v) + d0 + w - T w,    d = clip(v),
 * where T is the low pass A (A + rho I)^-1. Gradient steps would take hundreds, since A is small for most
 * patterns that pixels can show. turned = w, 0 outside the picture: nothing is clipped there. v begins with
 * twice what is beyond [0, 1]. */
TRIAD_FUNCTION Lanes refine_turn(Lanes v, Lanes d0) { return 2.0f * lanes_saturate(v) - v - d0; }

kernel void refine_begin(global const float* asked, global float* shown, global float* turned, uint runs,
                         uint rows, uint groups, uint planes, uint phases, uint first_phase, uint first,
                         uint stride, uint plane_floats, uint width, uint cell_x) {
    const TapRun r = tap_run(runs, rows, groups, phases, first_phase, planes);
    const int inside = refine_inside(&r, width, cell_x);
    for (uint k = 0u; k < DISPLAY_ROWS && tap_has_row(&r, k); ++k) {
        const size_t at = refine_at(&r, k, first, stride, plane_floats);
        const Lanes d0 = LANES_LOAD(asked + at), v = 2.0f * d0 - lanes_saturate(d0);
        LANES_STORE(v, shown + at);
        LANES_STORE(LANES_WHERE(LANES_INDICES < inside, refine_turn(v, d0)), turned + at);
    }
}

kernel void refine_step(global const float* asked, global float* shown, global const float* turned,
                        global float* next_turned, global const int* offsets, global const float* weights,
                        uint runs, uint rows, uint groups, uint planes, uint phases, uint first_phase,
                        uint first, uint stride, uint plane_floats, uint width, uint cell_x) {
    const TapRun r = tap_run(runs, rows, groups, phases, first_phase, planes);
    if (!tap_has_row(&r, 0u)) return;
    const int inside = refine_inside(&r, width, cell_x);
    global const float* from[DISPLAY_ROWS];
    for (uint k = 0u; k < DISPLAY_ROWS; ++k) from[k] = turned + refine_at(&r, k, first, stride, plane_floats);
    Lanes smooth[DISPLAY_ROWS];
    lanes_sum(from, offsets + r.table, weights + r.table, smooth);
    for (uint k = 0u; k < DISPLAY_ROWS; ++k)
        if (tap_has_row(&r, k)) {
            const size_t at = refine_at(&r, k, first, stride, plane_floats);
            const Lanes d0 = LANES_LOAD(asked + at), before = LANES_LOAD(shown + at);
            const Lanes v = before - lanes_saturate(before) + d0 + LANES_LOAD(from[k]) - smooth[k];
            LANES_STORE(v, shown + at);
            LANES_STORE(LANES_WHERE(LANES_INDICES < inside, refine_turn(v, d0)), next_turned + at);
        }
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
    const Vec4 sum = vec4_make(drives[at], drives[at + channel], drives[at + 2 * channel],
                               slab->channels == 4u ? drives[at + 3 * channel] : 1.0f);
    const Vec4 v = display_of_sum(slab, sum);
    vec4_store(slab->order == TONE_NEVER
                   ? v
                   : vec4_make(math_saturate(v.x), math_saturate(v.y), math_saturate(v.z), v.w),
               display, item);
}
