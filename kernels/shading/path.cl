/* Samples of the film's pixels, as a megakernel: one work-item is one pixel, and loops over the samples of
 * the launch. */
#include "common/language.h"

#include "common/film.h"
#include "shading/path_trace.h"
#include "shading/sample.h"

#define TRACE_PARAMETERS                                                                               \
    SCENE_PARAMETERS, global long *sums, global long *half_sums, global uint *samples,                 \
        volatile global uint *counters, global const TileWork *work, uint first_work, uint work_count, \
        uint first_sample_low, uint first_sample_high, uint first_pixel

/* What one item of trace_paths does. */
TRIAD_FUNCTION_ONCE void trace_pixel(TRACE_PARAMETERS, size_t item) {
    if (item >= (size_t)work_count * FILM_TILE_PIXELS) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    work += first_work + item / FILM_TILE_PIXELS;
    uint x, y;
    if (!sample_pixel(local_frame.crop, work->tile * FILM_TILE_PIXELS + item % FILM_TILE_PIXELS, &x, &y))
        return;
    const uint set = (x ^ y) & 1u, sample_count = work->sample_count[set];
    const uint full_pixel = film_pixel(&local_frame, x, y);
    const size_t pixel = (size_t)y * local_frame.crop[2] + x;
    const uint bins = local_frame.bins[0] * local_frame.bins[1];
    const ulong first = (((ulong)first_sample_high << 32) | first_sample_low) + work->first_sample[set];
    Tally tally = {0u, 0u, 0u, 0u, 0u};
    for (uint i = 0u; i < sample_count; ++i) {
        const SampleName name = sample_name(&local_frame, full_pixel, first + i);
        SampleWeight weight;
        const Ray ray = sample_camera_ray(&local_frame, ray_filter, &name, x, y, &weight);
        const float4 value = sample_weighted(path_trace(&scene, &name.path, ray, &tally), weight);
        if (!film_is_finite(value)) {
            ++tally.not_finite;
            continue;
        }
        uint saturated = 0u;
        const long r = film_fixed(value.x, local_frame.quanta, &saturated);
        const long g = film_fixed(value.y, local_frame.quanta, &saturated);
        const long b = film_fixed(value.z, local_frame.quanta, &saturated);
        const long a = film_fixed(value.w, local_frame.quanta, &saturated);
        tally.saturated += saturated;
        global long* sum = sums + ((pixel - first_pixel) * bins + name.bin) * FILM_CHANNELS;
        sum[0] = add_sat(sum[0], r), sum[1] = add_sat(sum[1], g), sum[2] = add_sat(sum[2], b),
        sum[3] = add_sat(sum[3], a);
        if (name.half_index == 0u) {
            global long* half_sum = half_sums + (pixel - first_pixel) * 3;
            half_sum[0] = add_sat(half_sum[0], r), half_sum[1] = add_sat(half_sum[1], g),
            half_sum[2] = add_sat(half_sum[2], b);
        }
    }
    samples[pixel] += sample_count;
    counter_add(counters, COUNTER_RAYS, tally.rays);
    counter_add(counters, COUNTER_NOT_FINITE, tally.not_finite);
    counter_add(counters, COUNTER_SATURATED, tally.saturated);
    counter_add(counters, COUNTER_TRUNCATED, tally.truncated);
    counter_add(counters, COUNTER_CUT_ENERGY, tally.cut_energy);
}

/* Adds to the film the samples that work[first_work, first_work + work_count) names, from first_sample on. */
kernel void trace_paths(TRACE_PARAMETERS) {
    trace_pixel(SCENE_ARGUMENTS, sums, half_sums, samples, counters, work, first_work, work_count,
                first_sample_low, first_sample_high, first_pixel, get_global_id(0));
}
