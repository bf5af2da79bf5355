/* The launches of the driver `wave` that shade (path/wave.h). */
#define TRIAD_ITEM_LANES 0

#include "common/language.h"

#include "path/add.h"
#include "path/emission.h"
#include "path/fork.h"
#include "path/survive.h"
#include "path/wave.h"

/* What paths find and do at the ends of their edges. */
kernel void shade_vertices(SCENE_PARAMETERS PARAMETERS(SHADE_VERTICES_LIST)) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    Tally tally = tally_start();
    TRIAD_ITEMS(i, path_count) {
        if (states[i] == WAVE_HIT) {
            PathState path;
            Hit hit;
            WAVE_LOAD(path, paths, &path);
            WAVE_LOAD(hit, hits, &hit);
            uint state = WAVE_END;
            const SamplerBlock u = path_numbers(&path);
            Vertex vertex = path_surface(&scene, &path, &hit, &tally);
            if (!path_unlit(&scene, &path, &vertex, &tally)) {
                path_emission(&scene, &path, &vertex, &tally);
                if (path_is_longest(&scene, &path)) {
                    state |= WAVE_LONGEST;
                } else {
                    path_fork(&scene, &path, &vertex);
                    const VertexBsdf bsdf = path_bsdf(&scene, &path, &vertex);
                    path_gather(&scene, &path, &vertex, &bsdf);
                    PendingLight light;
                    if (path_connect(&scene, &path, &vertex, &bsdf, &u, &light)) {
                        WAVE_STORE(light, pending, &light);
                        state |= WAVE_LIGHT;
                    }
                    Scatter scatter;
                    if (path_scatter(&scene, &path, &vertex, &bsdf, &u, &scatter, &tally) &&
                        path_survive(&scene, &path, &vertex, &scatter, &u, &tally))
                        state = (state & WAVE_LIGHT) | WAVE_EDGE;
                }
            }
            WAVE_STORE(path, paths, &path);
            states[i] = state;
        }
    }
}

/* The pixel of a slot. */
typedef struct WavePixel {
    uint x, y, count; /* samples that it is given */
    ulong first;      /* the first of them */
} WavePixel;

/* pixel: counted over tiles. 0: it lies outside the crop, or is given no samples. */
TRIAD_FUNCTION int wave_pixel(const Frame* frame, global const TileWork* tiles, ulong first_sample,
                              uint pixel, WavePixel* p) {
    const global TileWork* tile = tiles + pixel / FILM_TILE_PIXELS;
    const int inside = sample_pixel(frame->crop, tile->tile * FILM_TILE_PIXELS + pixel % FILM_TILE_PIXELS,
                                    &p->x, &p->y);
    const uint set = (p->x ^ p->y) & 1u;
    p->count = tile->sample_count[set];
    p->first = first_sample + tile->first_sample[set];
    return inside && p->count != 0u;
}

#define WAVE_FIRST_SAMPLE (((ulong)first_sample_high << 32) | first_sample_low)

/* Paths that have ended go on with another wavelength, or to the film. */
kernel void end_paths(SCENE_PARAMETERS PARAMETERS(END_PATHS_LIST)) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    Tally tally = tally_start();
    uint idle = 0u;
    TRIAD_ITEMS(i, path_count) {
        uint state = states[i];
        int next = state == WAVE_NEW;
        if (state == WAVE_MISS || (state & ~WAVE_LONGEST) == WAVE_END) {
            PathState path;
            WAVE_LOAD(path, paths, &path);
            if (state & WAVE_LONGEST) path_cut(&path, &tally);
            if (state == WAVE_MISS) {
                Hit hit;
                hit.primitive = TRIAD_NONE;
                path_miss(&scene, &path, &hit, &tally);
            }
            if (path_next_wavelength(&path)) {
                WAVE_STORE(path, paths, &path);
                state = WAVE_EDGE;
            } else {
                WavePixel p;
                wave_pixel(&local_frame, work + first_work, WAVE_FIRST_SAMPLE, pixels[i], &p);
                const uint had = taken[i];
                const CameraSample sample =
                    camera_sample(&scene, &local_frame, p.x, p.y, p.first + had);
                const size_t pixel = (size_t)p.y * local_frame.crop[2] + p.x - first_pixel;
                film_add(&local_frame,
                         sums + pixel * local_frame.bins[0] * local_frame.bins[1] * FILM_CHANNELS,
                         half_sums + pixel * 3, &sample.name, path_value(&path, sample.weight), &tally);
                taken[i] = had + 1u;
                state = WAVE_START;
                next = had + 1u == p.count;
            }
        }
        while (next) {
            const uint item = atomic_inc(progress);
            WavePixel p;
            if (item >= work_count * FILM_TILE_PIXELS) {
                state = WAVE_IDLE;
                next = 0;
                ++idle;
            } else if (wave_pixel(&local_frame, work + first_work, WAVE_FIRST_SAMPLE, item, &p)) {
                samples[(size_t)p.y * local_frame.crop[2] + p.x] += p.count;
                pixels[i] = item;
                taken[i] = 0u;
                state = WAVE_START;
                next = 0;
            }
        }
        states[i] = state;
    }
    if (idle != 0u) atomic_add(progress + 1, idle);
    tally_add(counters, &tally);
}

/* Samples become paths. */
kernel void start_paths(SCENE_PARAMETERS PARAMETERS(START_PATHS_LIST)) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    TRIAD_ITEMS(i, path_count) {
        if (states[i] == WAVE_START) {
            WavePixel p;
            wave_pixel(&local_frame, work + first_work, WAVE_FIRST_SAMPLE, pixels[i], &p);
            const CameraSample sample = camera_sample(&scene, &local_frame, p.x, p.y, p.first + taken[i]);
            PathState path = path_start(&scene, &sample);
            WAVE_STORE(path, paths, &path);
            states[i] = WAVE_EDGE;
        }
    }
}
