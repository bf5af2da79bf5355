/* Every pixel as the regression of its neighbours' colours on their guides (Bitterli et al. 2016,
 * "Nonlinearly Weighted First-Order Regression for Denoising Monte Carlo Renderings"), weighted by how alike
 * patches of the other half of the samples are (Rousselle et al. 2012, "Adaptive Rendering with Non-Local
 * Means Filtering"). */
#include "denoise/denoise.h"

#define LANES DENOISE_LANES
#include "common/lanes.h"

/* Neighbours whose products are added at once, a row of them on a CPU: sums are read and written as often
 * less.
 */
#if DENOISE_LANES > 1
#define DENOISE_ABREAST DENOISE_SIDE
#define DENOISE_UNROLL
#else
#define DENOISE_ABREAST 1
/* Sums in registers: their places must be constants. */
#define DENOISE_UNROLL _Pragma("unroll")
#endif

/* Squared differences of the pixels of `rows` rows from `first_row` on (and DENOISE_PATCH rows more on each
 * side) to those that they look at, over the variance that they have by noise: [offset][row][cell].
 * half_planes: DENOISE_FIRST or DENOISE_SECOND. */
kernel void measure_distances(global const DenoiseShape* shape, global const float* planes, uint half_planes,
                              uint first_row, uint rows, global float* distances) {
    const uint runs = shape->stride / DENOISE_LANES, tall = rows + 2u * DENOISE_PATCH;
    const uint item = (uint)get_global_id(0), run = item % runs, row = item / runs % tall,
               offset = item / runs / tall;
    if (offset >= DENOISE_SIDE * DENOISE_SIDE) return;
    /* At the outer border of the margin it looks at the rows around, which are no matter: no patch of the
     * picture reaches there. */
    const uint cell = run * DENOISE_LANES;
    const int dy = (int)(offset / DENOISE_SIDE) - DENOISE_REACH,
              dx = (int)(offset % DENOISE_SIDE) - DENOISE_REACH;
    const size_t line =
        (size_t)((int)(first_row + row) - DENOISE_PATCH + DENOISE_MARGIN) * shape->stride + cell;
    const size_t other = line + (size_t)((ptrdiff_t)dy * (ptrdiff_t)shape->stride + dx);
    Lanes sum = (Lanes)(0.0f);
    for (uint c = 0u; c < 3u; ++c) {
        global const float* colours = planes + (size_t)(half_planes + c) * shape->plane;
        global const float* variances = planes + (size_t)(DENOISE_VARIANCE + c) * shape->plane;
        const Lanes difference = LANES_LOAD(colours + line) - LANES_LOAD(colours + other);
        const Lanes own = LANES_LOAD(variances + line), others = LANES_LOAD(variances + other);
        sum += (difference * difference - (own + fmin(own, others))) / (1e-10f + own + others);
    }
    LANES_STORE(sum * (1.0f / 3.0f), distances + ((size_t)offset * tall + row) * shape->stride + cell);
}

/* Normal equations of a pixel. gram: lower triangle; sums: [term][channel]. */
typedef struct DenoiseNormal {
    Lanes gram[DENOISE_GRAM], sums[DENOISE_TERMS * 3];
} DenoiseNormal;

/* The products of DENOISE_ABREAST neighbours. values: their terms, then their colours. */
TRIAD_FUNCTION void denoise_add(DenoiseNormal* normal, const Lanes* weights,
                                Lanes values[DENOISE_TERMS + 3][DENOISE_ABREAST]) {
    DENOISE_UNROLL for (int i = 0; i < DENOISE_TERMS; ++i) {
        Lanes weighted[DENOISE_ABREAST];
#pragma unroll
        for (int k = 0; k < DENOISE_ABREAST; ++k) weighted[k] = weights[k] * values[i][k];
        DENOISE_UNROLL for (int j = 0; j <= i; ++j) {
            Lanes sum = normal->gram[DENOISE_ENTRY(i, j)];
#pragma unroll
            for (int k = 0; k < DENOISE_ABREAST; ++k) sum = fma(weighted[k], values[j][k], sum);
            normal->gram[DENOISE_ENTRY(i, j)] = sum;
        }
        DENOISE_UNROLL for (int c = 0; c < 3; ++c) {
            Lanes sum = normal->sums[i * 3 + c];
#pragma unroll
            for (int k = 0; k < DENOISE_ABREAST; ++k)
                sum = fma(weighted[k], values[DENOISE_TERMS + c][k], sum);
            normal->sums[i * 3 + c] = sum;
        }
    }
}

/* Solves them for the constant term: what is left of the first row when the others are eliminated. */
TRIAD_FUNCTION void denoise_solve(DenoiseNormal* normal) {
    DENOISE_UNROLL for (int n = DENOISE_TERMS - 1; n > 0; --n) {
        const Lanes inverse = 1.0f / normal->gram[DENOISE_ENTRY(n, n)];
        DENOISE_UNROLL for (int i = 0; i < n; ++i) {
            const Lanes factor = normal->gram[DENOISE_ENTRY(n, i)] * inverse;
            DENOISE_UNROLL for (int j = 0; j <= i; ++j) normal->gram[DENOISE_ENTRY(i, j)] -=
                factor * normal->gram[DENOISE_ENTRY(n, j)];
            DENOISE_UNROLL for (int c = 0; c < 3; ++c) normal->sums[i * 3 + c] -=
                factor * normal->sums[n * 3 + c];
        }
    }
}

/* Sum over a patch of distances, which lie in rows of `stride`. */
TRIAD_FUNCTION Lanes denoise_patch(global const float* distances, int stride, int patch) {
    Lanes sum = (Lanes)(0.0f);
    for (int j = -patch; j <= patch; ++j)
        for (int i = -patch; i <= patch; ++i) sum += LANES_LOAD(distances + j * stride + i);
    return sum;
}

/* The pixels of `rows` rows from `first_row` on. half_planes: whose colours; the distances are of the other
 * half. scale: 1 / (cells of a patch x k^2), k the strength of the filter. out: [3] planes from out_planes
 * on.
 */
kernel void regress(global const DenoiseShape* shape, global const float* planes, global const float* guides,
                    global const float* distances, uint half_planes, uint first_row, uint rows, int patch,
                    float scale, global float* out, uint out_planes) {
    const uint runs = (shape->width + DENOISE_LANES - 1u) / DENOISE_LANES, item = (uint)get_global_id(0),
               run = item % runs, row = item / runs;
    if (row >= rows) return;
    const int y = (int)(first_row + row), x = (int)(run * DENOISE_LANES), stride = (int)shape->stride,
              width = (int)shape->width;
    const size_t at = denoise_at(shape, x, y), plane = shape->plane;
    global const float* colours = planes + half_planes * plane;
    DenoiseNormal normal;
    Lanes values[DENOISE_TERMS + 3][DENOISE_ABREAST], weights[DENOISE_ABREAST];
    DENOISE_UNROLL for (int i = 0; i < DENOISE_GRAM; ++i) normal.gram[i] = (Lanes)(0.0f);
    DENOISE_UNROLL for (int i = 0; i < DENOISE_TERMS * 3; ++i) normal.sums[i] = (Lanes)(0.0f);
    DENOISE_UNROLL for (int k = 0; k < DENOISE_ABREAST; ++k) values[0][k] = (Lanes)(1.0f);
    const int left_above = y, left_below = (int)shape->height - 1 - y;
    const int above = left_above < DENOISE_REACH ? -left_above : -DENOISE_REACH,
              below = left_below < DENOISE_REACH ? left_below : DENOISE_REACH;
    for (int dy = above; dy <= below; ++dy)
        for (int first = -DENOISE_REACH; first <= DENOISE_REACH; first += DENOISE_ABREAST) {
            for (int k = 0; k < DENOISE_ABREAST; ++k) {
                const int dx = first + k, offset = (dy + DENOISE_REACH) * DENOISE_SIDE + dx + DENOISE_REACH;
                global const float* distance =
                    distances +
                    ((size_t)offset * (rows + 2u * DENOISE_PATCH) + row + DENOISE_PATCH) * shape->stride +
                    (size_t)(x + DENOISE_MARGIN);
                const Lanes weight = exp(-fmax(denoise_patch(distance, stride, patch) * scale, 0.0f));
                weights[k] =
                    LANES_WHERE((x + dx + LANES_INDICES >= 0) & (x + dx + LANES_INDICES < width), weight);
                const size_t q = at + (size_t)((ptrdiff_t)dy * stride + dx);
                DENOISE_UNROLL for (int i = 1; i < DENOISE_TERMS; ++i) {
                    global const float* guide = guides + (size_t)(i - 1) * plane;
                    values[i][k] = LANES_LOAD(guide + q) - LANES_LOAD(guide + at);
                }
                DENOISE_UNROLL for (int c = 0; c < 3; ++c) values[DENOISE_TERMS + c][k] =
                    LANES_LOAD(colours + (size_t)c * plane + q);
            }
            denoise_add(&normal, weights, values);
        }
    /* A ridge: guides that hardly change around a pixel explain nothing. */
    DENOISE_UNROLL for (int i = 1; i < DENOISE_TERMS; ++i) normal.gram[DENOISE_ENTRY(i, i)] +=
        3e-4f * normal.gram[0] + 1e-9f;
    denoise_solve(&normal);
    DENOISE_UNROLL for (int c = 0; c < 3; ++c)
        LANES_STORE(normal.sums[c] / normal.gram[0], out + (out_planes + (size_t)c) * plane + at);
}
