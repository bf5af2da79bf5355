/* The path tracer as a megakernel: one work-item is one pixel, and loops over the samples of the launch.
 * Unidirectional paths with next-event estimation, multiple importance sampling and Russian roulette. */
#include "common/language.h"

#include "path/add.h"
#include "path/mega.h"

TRIAD_FUNCTION_WHOLE void trace_pixel(SCENE_PARAMETERS PARAMETERS(TRACE_PATHS_LIST), size_t item) {
    if (item >= (size_t)work_count * FILM_TILE_PIXELS) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    work += first_work + item / FILM_TILE_PIXELS;
    uint x, y;
    if (!sample_pixel(local_frame.crop, work->tile * FILM_TILE_PIXELS + item % FILM_TILE_PIXELS, &x, &y))
        return;
    const uint set = (x ^ y) & 1u, sample_count = work->sample_count[set];
    const ulong first = (((ulong)first_sample_high << 32) | first_sample_low) + work->first_sample[set];
    const size_t pixel = (size_t)y * local_frame.crop[2] + x;
    samples[pixel] += sample_count;
    sums += (pixel - first_pixel) * local_frame.bins[0] * local_frame.bins[1] * FILM_CHANNELS;
    half_sums += (pixel - first_pixel) * 3;
    Tally tally = tally_start();
    for (uint i = 0u; i < sample_count; ++i) {
        const CameraSample sample = camera_sample(&scene, &local_frame, x, y, first + i);
        PathState path = path_start(&scene, &sample);
        mega_follow(&scene, &path, &tally);
        film_add(&local_frame, sums, half_sums, &sample.name, path_value(&path, sample.weight), &tally);
    }
    tally_add(counters, &tally);
}

/* Adds to the film the samples that the work names. */
kernel void trace_paths(SCENE_PARAMETERS PARAMETERS(TRACE_PATHS_LIST)) {
    trace_pixel(SCENE_ARGUMENTS ARGUMENTS(TRACE_PATHS_LIST), get_global_id(0));
}
