/* What goes into the denoiser, and which of its candidates a pixel takes. */
#include "denoise/denoise.h"

/* How much a half of a pixel may have, by the other half and the pixels around. */
TRIAD_FUNCTION float denoise_bounded(float own, float other, float around) {
    return fmin(own, DENOISE_SPARK * fmax(other, fmax(around, 0.01f)));
}

/* Sparks: single samples of a light that hardly any finds. A filter could only spread them, so that what one
 * half alone has far more of than there is around is bounded. A channel of a pixel for each item; first,
 * second: as of fill_planes. */
kernel void bound_sparks(global const DenoiseShape* shape, global const float* first,
                         global const float* second, global float* bounded_first,
                         global float* bounded_second) {
    const uint own = (uint)get_global_id(0), item = own / 3u;
    if (item >= shape->width * shape->height) return;
    const int x = (int)(item % shape->width), y = (int)(item / shape->width);
    float around = 0.0f, count = 0.0f;
    for (int j = -DENOISE_ERROR_REACH; j <= DENOISE_ERROR_REACH; ++j)
        for (int i = -DENOISE_ERROR_REACH; i <= DENOISE_ERROR_REACH; ++i) {
            const size_t q = 3u * ((size_t)denoise_inside(y + j, shape->height) * shape->width +
                                   (size_t)denoise_inside(x + i, shape->width)) +
                             own % 3u;
            if (q == own) continue; /* also where it stands for what is beyond the border */
            around += first[q] + second[q], count += 2.0f;
        }
    around /= fmax(count, 1.0f);
    bounded_first[own] = denoise_bounded(first[own], second[own], around);
    bounded_second[own] = denoise_bounded(second[own], first[own], around);
}

/* Planes of what the samples say. first, second: HalfMeans (host/scene/film.h), [pixel][3]. The variance is
 * that of the mean absolute difference around: the mean square would be the few bright pixels' alone, and
 * dark ones beside a lamp would take its light for noise. Those, too, are why r is not above the pixel's own
 * mean. */
kernel void fill_planes(global const DenoiseShape* shape, global const float* first,
                        global const float* second, global float* planes) {
    const uint cell = (uint)get_global_id(0);
    if (cell >= shape->plane) return;
    const int x = denoise_inside((int)(cell % shape->stride) - DENOISE_MARGIN, shape->width);
    const int y = denoise_inside((int)(cell / shape->stride) - DENOISE_MARGIN, shape->height);
    for (uint c = 0u; c < 3u; ++c) {
        float deviation = 0.0f, mean = 0.0f;
        for (int j = -DENOISE_VARIANCE_REACH; j <= DENOISE_VARIANCE_REACH; ++j)
            for (int i = -DENOISE_VARIANCE_REACH; i <= DENOISE_VARIANCE_REACH; ++i) {
                const size_t q = 3u * ((size_t)denoise_inside(y + j, shape->height) * shape->width +
                                       (size_t)denoise_inside(x + i, shape->width)) +
                                 c;
                deviation += fabs(first[q] - second[q]);
                if (abs(i) <= DENOISE_ERROR_REACH && abs(j) <= DENOISE_ERROR_REACH)
                    mean += first[q] + second[q];
            }
        const float side = 2.0f * DENOISE_VARIANCE_REACH + 1.0f, inner = 2.0f * DENOISE_ERROR_REACH + 1.0f;
        deviation /= side * side;
        const size_t own = 3u * ((size_t)y * shape->width + (size_t)x) + c;
        const float r = fmax(0.5f * fmin(mean / (inner * inner), first[own] + second[own]), 0.0f);
        planes[(size_t)(DENOISE_FIRST + c) * shape->plane + cell] = first[own];
        planes[(size_t)(DENOISE_SECOND + c) * shape->plane + cell] = second[own];
        planes[(size_t)(DENOISE_VARIANCE + c) * shape->plane + cell] = 0.75f * deviation * deviation;
        planes[(size_t)(DENOISE_WEIGHT + c) * shape->plane + cell] = 1.0f / (r * r + 0.01f);
    }
}

/* guides: of a film, [pixel][DENOISE_GUIDES]. Depth becomes what is near 2 at the eye and 0 far away. */
kernel void fill_guides(global const DenoiseShape* shape, global const float* guides, global float* planes) {
    const uint cell = (uint)get_global_id(0);
    if (cell >= shape->plane) return;
    const int x = denoise_inside((int)(cell % shape->stride) - DENOISE_MARGIN, shape->width);
    const int y = denoise_inside((int)(cell / shape->stride) - DENOISE_MARGIN, shape->height);
    global const float* of = guides + DENOISE_GUIDES * ((size_t)y * shape->width + (size_t)x);
    for (uint i = 0u; i < DENOISE_GUIDES; ++i) {
        const float middle = shape->middle_depth, value = of[i];
        planes[(size_t)i * shape->plane + cell] =
            i + 1u < DENOISE_GUIDES ? value : (value >= 0.0f ? 2.0f * middle / (middle + value) : 0.0f);
    }
}

/* The squared relative error of every pixel of a candidate, estimated without bias as far as a half's
 * filtered colours do not depend on the other half: what they differ by from it, less its noise. filtered: of
 * candidate i > 0 the halves' colours, [2][3] planes each; candidate 0 is the mean of the samples. errors: a
 * plane for each candidate. */
kernel void measure_errors(global const DenoiseShape* shape, global const float* planes,
                           global const float* filtered, uint candidate, global float* errors) {
    const uint item = (uint)get_global_id(0);
    if (item >= shape->width * shape->height) return;
    const size_t at = denoise_at(shape, (int)(item % shape->width), (int)(item / shape->width));
    float error = 0.0f;
    for (uint c = 0u; c < 3u; ++c) {
        const size_t plane = shape->plane;
        const float a = planes[(DENOISE_FIRST + c) * plane + at],
                    b = planes[(DENOISE_SECOND + c) * plane + at];
        const float weight = planes[(DENOISE_WEIGHT + c) * plane + at], noise = 0.5f * (a - b) * (a - b);
        if (candidate == 0u) {
            error += 0.5f * noise * weight;
        } else {
            global const float* of = filtered + (size_t)(candidate - 1u) * 6u * plane + at;
            const float fa = of[c * plane], fb = of[(3u + c) * plane];
            error +=
                (0.5f * ((fa - b) * (fa - b) + (fb - a) * (fb - a)) - noise - 0.25f * (fa - fb) * (fa - fb)) *
                weight;
        }
    }
    errors[(size_t)candidate * shape->plane + at] = error;
}

/* Which of `candidates` (their errors in planes, the samples' own first) has the least error around each
 * pixel. */
kernel void choose(global const DenoiseShape* shape, global const float* errors, uint candidates,
                   global uint* choices) {
    const uint item = (uint)get_global_id(0);
    if (item >= shape->width * shape->height) return;
    const int x = (int)(item % shape->width), y = (int)(item / shape->width);
    float least = INFINITY;
    uint best = 0u;
    for (uint candidate = 0u; candidate < candidates; ++candidate) {
        float error = 0.0f;
        for (int j = -DENOISE_ERROR_REACH; j <= DENOISE_ERROR_REACH; ++j)
            for (int i = -DENOISE_ERROR_REACH; i <= DENOISE_ERROR_REACH; ++i)
                error += errors[candidate * (size_t)shape->plane +
                                denoise_at(shape, denoise_inside(x + i, shape->width),
                                           denoise_inside(y + j, shape->height))];
        if (error < least) least = error, best = candidate;
    }
    choices[item] = best;
}

/* The mixture of what the pixels around have chosen. means: of the samples, [pixel][4], replaced by the
 * result; alpha stays. filtered: as of measure_errors. */
kernel void mix_choices(global const DenoiseShape* shape, global const uint* choices,
                        global const float* filtered, uint candidates, global float* means) {
    const uint item = (uint)get_global_id(0);
    if (item >= shape->width * shape->height) return;
    const int x = (int)(item % shape->width), y = (int)(item / shape->width);
    const size_t at = denoise_at(shape, x, y), plane = shape->plane;
    for (uint c = 0u; c < 3u; ++c) {
        float sum = 0.0f;
        for (uint candidate = 0u; candidate < candidates; ++candidate) {
            float count = 0.0f;
            for (int j = -DENOISE_ERROR_REACH; j <= DENOISE_ERROR_REACH; ++j)
                for (int i = -DENOISE_ERROR_REACH; i <= DENOISE_ERROR_REACH; ++i)
                    count += choices[denoise_inside(y + j, shape->height) * (int)shape->width +
                                     denoise_inside(x + i, shape->width)] == candidate
                                 ? 1.0f
                                 : 0.0f;
            if (count == 0.0f) continue;
            float value = means[4u * (size_t)item + c];
            if (candidate > 0u) {
                global const float* of = filtered + (size_t)(candidate - 1u) * 6u * plane + at;
                value = 0.5f * (of[c * plane] + of[(3u + c) * plane]);
            }
            sum += count * value;
        }
        const float side = 2.0f * DENOISE_ERROR_REACH + 1.0f;
        means[4u * (size_t)item + c] = sum / (side * side);
    }
}
