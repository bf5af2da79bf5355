/* Every pixel as the regression of its neighbours' colours on their guides (Bitterli et al. 2016,
 * "Nonlinearly Weighted First-Order Regression for Denoising Monte Carlo Renderings"), weighted by how alike
 * patches of the other half of the samples are (Rousselle et al. 2012, "Adaptive Rendering with Non-Local
 * Means Filtering"). */
#include "denoise/denoise.h"

/* Squared differences of the pixels of `rows` rows from `first_row` on (and DENOISE_PATCH rows more on each
 * side) to those that they look at, over the variance that they have by noise: [offset][row][cell].
 * half: DENOISE_FIRST or DENOISE_SECOND. */
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
    float sums[DENOISE_LANES];
    DENOISE_EACH_LANE sums[l] = 0.0f;
    const size_t line =
        (size_t)((int)(first_row + row) - DENOISE_PATCH + DENOISE_MARGIN) * shape->stride + cell;
    const size_t other = line + (size_t)((ptrdiff_t)dy * (ptrdiff_t)shape->stride + dx);
    for (uint c = 0u; c < 3u; ++c) {
        global const float* colours = planes + (size_t)(half_planes + c) * shape->plane;
        global const float* variances = planes + (size_t)(DENOISE_VARIANCE + c) * shape->plane;
        DENOISE_EACH_LANE {
            const float difference = colours[line + l] - colours[other + l];
            const float own = variances[line + l], others = variances[other + l];
            sums[l] += (difference * difference - (own + fmin(own, others))) / (1e-10f + own + others);
        }
    }
    global float* to = distances + ((size_t)offset * tall + row) * shape->stride + cell;
    DENOISE_EACH_LANE to[l] = sums[l] * (1.0f / 3.0f);
}

/* Solves the normal equations for the constant term: what is left of the first row when the others are
 * eliminated. gram: lower triangle; sums: [term][channel]. */
TRIAD_FUNCTION void denoise_solve(float gram[DENOISE_GRAM][DENOISE_LANES],
                                  float sums[DENOISE_TERMS * 3][DENOISE_LANES]) {
    for (int n = DENOISE_TERMS - 1; n > 0; --n) {
        float inverse[DENOISE_LANES];
        DENOISE_EACH_LANE inverse[l] = 1.0f / gram[DENOISE_ENTRY(n, n)][l];
        for (int i = 0; i < n; ++i) {
            float factor[DENOISE_LANES];
            DENOISE_EACH_LANE factor[l] = gram[DENOISE_ENTRY(n, i)][l] * inverse[l];
            for (int j = 0; j <= i; ++j)
                DENOISE_EACH_LANE gram[DENOISE_ENTRY(i, j)][l] -= factor[l] * gram[DENOISE_ENTRY(n, j)][l];
            for (int c = 0; c < 3; ++c)
                DENOISE_EACH_LANE sums[i * 3 + c][l] -= factor[l] * sums[n * 3 + c][l];
        }
    }
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
    if (row >= rows || first_row + row >= shape->height) return;
    const int y = (int)(first_row + row), x = (int)(run * DENOISE_LANES);
    const size_t at = denoise_at(shape, x, y), plane = shape->plane;
    const int stride = (int)shape->stride;
    global const float* colours = planes + half_planes * plane;
    float gram[DENOISE_GRAM][DENOISE_LANES], sums[DENOISE_TERMS * 3][DENOISE_LANES];
    float terms[DENOISE_TERMS][DENOISE_LANES], weighted[DENOISE_LANES], weights[DENOISE_LANES];
    for (int i = 0; i < DENOISE_GRAM; ++i) DENOISE_EACH_LANE gram[i][l] = 0.0f;
    for (int i = 0; i < DENOISE_TERMS * 3; ++i) DENOISE_EACH_LANE sums[i][l] = 0.0f;
    DENOISE_EACH_LANE terms[0][l] = 1.0f;
    for (int offset = 0; offset < DENOISE_SIDE * DENOISE_SIDE; ++offset) {
        const int dy = offset / DENOISE_SIDE - DENOISE_REACH, dx = offset % DENOISE_SIDE - DENOISE_REACH;
        if (y + dy < 0 || y + dy >= (int)shape->height) continue;
        global const float* distance =
            distances + ((size_t)offset * (rows + 2u * DENOISE_PATCH) + row + DENOISE_PATCH) * shape->stride +
            (size_t)(x + DENOISE_MARGIN);
        DENOISE_EACH_LANE weights[l] = 0.0f;
        for (int j = -patch; j <= patch; ++j)
            for (int i = -patch; i <= patch; ++i)
                DENOISE_EACH_LANE weights[l] += distance[j * stride + i + (int)l];
        DENOISE_EACH_LANE {
            const int other = x + (int)l + dx;
            weights[l] =
                other >= 0 && other < (int)shape->width ? exp(-fmax(weights[l] * scale, 0.0f)) : 0.0f;
        }
        const size_t q = at + (size_t)((ptrdiff_t)dy * stride + dx);
        for (int i = 1; i < DENOISE_TERMS; ++i) {
            global const float* guide = guides + (size_t)(i - 1) * plane;
            DENOISE_EACH_LANE terms[i][l] = guide[q + l] - guide[at + l];
        }
        for (int i = 0; i < DENOISE_TERMS; ++i) {
            DENOISE_EACH_LANE weighted[l] = weights[l] * terms[i][l];
            for (int j = 0; j <= i; ++j)
                DENOISE_EACH_LANE gram[DENOISE_ENTRY(i, j)][l] += weighted[l] * terms[j][l];
            for (int c = 0; c < 3; ++c) {
                global const float* colour = colours + (size_t)c * plane;
                DENOISE_EACH_LANE sums[i * 3 + c][l] += weighted[l] * colour[q + l];
            }
        }
    }
    /* A ridge: guides that hardly change around a pixel explain nothing. */
    for (int i = 1; i < DENOISE_TERMS; ++i)
        DENOISE_EACH_LANE gram[DENOISE_ENTRY(i, i)][l] += 3e-4f * gram[0][l] + 1e-9f;
    denoise_solve(gram, sums);
    for (int c = 0; c < 3; ++c)
        DENOISE_EACH_LANE out[(out_planes + (size_t)c) * plane + at + l] = sums[c][l] / gram[0][l];
}
