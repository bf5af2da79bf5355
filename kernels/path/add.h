/* Stage `add`: what a path has found goes to the film. */
#ifndef TRIAD_PATH_ADD_H
#define TRIAD_PATH_ADD_H

#include "path/record.h"
#include "path/start.h"

/* Radiance in R, G, B, and alpha, as the film counts them. */
TRIAD_FUNCTION Vec4 path_value(const PathState* path, SampleWeight weight) {
    return sample_weighted(vec3_with(path_rgb(&path->colours, path->radiance), path->alpha), weight);
}

/* sums, half_sums: of the pixel that the sample is of. */
TRIAD_FUNCTION void film_add(const Frame* frame, global long* sums, global long* half_sums,
                             const SampleName* name, Vec4 value, Tally* tally) {
    if (!film_is_finite(value)) {
        ++tally->not_finite;
        return;
    }
    uint saturated = 0u;
    const long r = film_fixed(value.x, frame->quanta, &saturated);
    const long g = film_fixed(value.y, frame->quanta, &saturated);
    const long b = film_fixed(value.z, frame->quanta, &saturated);
    const long a = film_fixed(value.w, frame->quanta, &saturated);
    tally->saturated += saturated;
    global long* sum = sums + name->bin * FILM_CHANNELS;
    sum[0] = add_sat(sum[0], r), sum[1] = add_sat(sum[1], g), sum[2] = add_sat(sum[2], b),
    sum[3] = add_sat(sum[3], a);
    if (name->half_index == 0u)
        half_sums[0] = add_sat(half_sums[0], r), half_sums[1] = add_sat(half_sums[1], g),
        half_sums[2] = add_sat(half_sums[2], b);
}

#endif
