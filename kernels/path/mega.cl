/* The path tracer as a megakernel: one work-item is one pixel, and loops over the samples of the launch.
 * Where the camera's rays are walked in packets, one of MEGA_BLOCK work-items has the pixels of all, and the
 * others nothing: groups are of as many pixels either way. Unidirectional paths with next-event estimation,
 * multiple importance sampling and Russian roulette. */
#include "common/language.h"

#include "path/add.h"
#include "path/camera_packet.h"
#include "path/mega.h"

#if TRIAD_PACKETS

/* The samples of a pixel that the work names. */
typedef struct PixelSamples {
    uint x, y;
    size_t pixel; /* of the crop */
    ulong first;
    uint count;
} PixelSamples;

/* Of pixel i of a block of the tile, which is 4 x 2 pixels; none outside the crop. */
TRIAD_FUNCTION PixelSamples block_samples(const Frame* frame, global const TileWork* work, uint block, uint i,
                                          ulong first_sample) {
    PixelSamples p;
    p.pixel = 0, p.first = 0ul, p.count = 0u;
    const uint in_tile = (block / 2u * 2u + i / 4u) * FILM_TILE + block % 2u * 4u + i % 4u;
    if (!sample_pixel(frame->crop, work->tile * FILM_TILE_PIXELS + in_tile, &p.x, &p.y)) return p;
    const uint set = (p.x ^ p.y) & 1u;
    p.pixel = (size_t)p.y * frame->crop[2] + p.x;
    p.first = first_sample + work->first_sample[set];
    p.count = work->sample_count[set];
    return p;
}

TRIAD_FUNCTION_WHOLE void trace_item(SCENE_PARAMETERS PARAMETERS(TRACE_PATHS_LIST), size_t item) {
    if (item >= (size_t)work_count * FILM_TILE_PIXELS || item % MEGA_BLOCK != 0u) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    work += first_work + item / FILM_TILE_PIXELS;
    const uint block = (uint)(item % FILM_TILE_PIXELS) / MEGA_BLOCK;
    const ulong first_sample = ((ulong)first_sample_high << 32) | first_sample_low;
    const size_t pixel_sums = local_frame.bins[0] * local_frame.bins[1] * FILM_CHANNELS;
    Tally tally = tally_start();
    PixelSamples at;
    at.count = 0u;
    uint started = 0u, next = 0u; /* samples of the present pixel; the next pixel of the block */
    for (;;) {
        CameraPacket packet; /* of one pixel, or of the end of one and the beginning of the next */
        size_t pixels[PACKET_RAYS];
        packet.count = 0u;
        while (packet.count < PACKET_RAYS) {
            if (started < at.count) {
                pixels[packet.count] = at.pixel - first_pixel;
                packet_add(&packet, camera_sample(&scene, &local_frame, at.x, at.y, at.first + started++));
            } else if (next < MEGA_BLOCK) {
                at = block_samples(&local_frame, work, block, next++, first_sample);
                if (at.count != 0u) samples[at.pixel] += at.count;
                started = 0u;
            } else {
                break;
            }
        }
        if (packet.count == 0u) break;
        packet_trace(&scene, &packet, &tally);
        for (uint i = 0u; i < packet.count; ++i) {
            PathState path = path_start(&scene, &packet.samples[i]);
            mega_follow(&scene, &path, &packet.hits[i], &tally);
            film_add(&local_frame, sums + pixels[i] * pixel_sums, half_sums + pixels[i] * 3,
                     &packet.samples[i].name, path_value(&path, packet.samples[i].weight), &tally);
        }
    }
    tally_add(counters, &tally);
}

#else

TRIAD_FUNCTION_WHOLE void trace_item(SCENE_PARAMETERS PARAMETERS(TRACE_PATHS_LIST), size_t item) {
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
        mega_follow(&scene, &path, 0, &tally);
        film_add(&local_frame, sums, half_sums, &sample.name, path_value(&path, sample.weight), &tally);
    }
    tally_add(counters, &tally);
}

#endif

/* Adds to the film the samples that the work names. */
kernel void trace_paths(SCENE_PARAMETERS PARAMETERS(TRACE_PATHS_LIST)) {
    trace_item(SCENE_ARGUMENTS ARGUMENTS(TRACE_PATHS_LIST), get_global_id(0));
}
