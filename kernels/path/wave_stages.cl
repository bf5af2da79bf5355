/* The driver `wave` where every stage of a round is a launch, and a work-item has a slot (path/wave.h): for
 * GPUs, which hide the memory that paths wait in, and where the registers of a kernel decide how many paths
 * are under way. */
#define TRIAD_STAGES 1
#ifndef TRIAD_INLINED
#define TRIAD_INLINED 1 /* structs that functions hand to each other stay in registers */
#endif

#include "common/language.h"

#include "path/wave_stages.h"

/* A stage takes of its arguments what it needs. */
#define WAVE_STAGE_PARAMETERS SCENE_PARAMETERS PARAMETERS(TRACE_WAVE_LIST)
#define WAVE_STAGE                                                                             \
    const size_t i = get_global_id(0) % POOL_SLOTS, item = get_global_id(0) / POOL_SLOTS;      \
    if (item >= pool_count) return;                                                            \
    const Scene scene = SCENE_FROM_PARAMETERS;                                                 \
    const Frame local_frame = *frame;                                                          \
    const WaveWork list = {&local_frame, work + first_work, work_count * FILM_TILE_PIXELS,     \
                           ((ulong)first_sample_high << 32) | first_sample_low};               \
    const WaveFilm film = {sums, half_sums, samples, first_pixel};                             \
    const Pool pool = pool_at(item, states, pixels, taken, rays, paths, hits, pending, films); \
    Tally tally = tally_start();                                                               \
    (void)list, (void)film, (void)tally, (void)next_pixel, (void)counters;

/* Rays are counted for each slot, and added up when it has nothing to do any more: else every item of these
 * launches would add to one word. */
#define WAVE_COUNT_RAYS                                   \
    do {                                                  \
        if (tally.rays != 0u) pool.rays[i] += tally.rays; \
        tally.rays = 0u;                                  \
    } while (0)

/* Adds samples to the film that the work names. next_pixel[1]: slots that have nothing to do any more. */
kernel void wave_end_paths(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    if (pool.states[i] == WAVE_NEW) pool.rays[i] = 0u;
    if (pool.states[i] != WAVE_IDLE && wave_end(&scene, &list, &film, &pool, i, next_pixel, &tally)) {
        atomic_inc(next_pixel + 1);
        tally.rays = pool.rays[i];
    }
    tally_add(counters, &tally);
}

kernel void wave_start_paths(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_start(&scene, &list, &pool, i);
}

kernel void wave_intersect_edges(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_edge(&scene, &pool, i, &tally);
    WAVE_COUNT_RAYS;
    tally_add(counters, &tally);
}

kernel void wave_meet_surfaces(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_meet(&scene, &pool, i, &tally);
    tally_add(counters, &tally);
}

kernel void wave_average_films(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_films(&scene, &pool, i);
}

kernel void wave_gather_photons(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_gather(&scene, &pool, i);
}

kernel void wave_connect_paths(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_connect(&scene, &pool, i);
}

kernel void wave_scatter_paths(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_scatter(&scene, &pool, i, &tally);
    tally_add(counters, &tally);
}

kernel void wave_intersect_lights(WAVE_STAGE_PARAMETERS) {
    WAVE_STAGE
    wave_shadow(&scene, &pool, i, &tally);
    WAVE_COUNT_RAYS;
    tally_add(counters, &tally);
}
