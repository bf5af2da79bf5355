/* The driver `wave` where a work-item has a pool of its own, and goes through the stages of a round one after
 * the other, each a loop over its slots (path/wave.h): for CPUs, whose caches hold such a pool. */
#ifndef TRIAD_ITEM_LANES
#define TRIAD_ITEM_LANES 0
#endif

#include "common/language.h"

#include "path/wave_stages.h"

#ifdef __clang__
#pragma clang diagnostic ignored "-Wpass-failed" /* where it cannot: triad bench kernels shows that */
#endif
#define POOL_LANES 8
#define WAVE_SLOTS(i) for (size_t i = 0; i < POOL_SLOTS; ++i)
/* The slots are lanes, a few at a time: where none of those is in the state, they are passed over. When the
 * list of work has come to its end, most are. */
#define WAVE_LANES(i, state)                                        \
    for (size_t first = 0; first < POOL_SLOTS; first += POOL_LANES) \
        if (wave_any(pool.states + first, state))                   \
    _Pragma("clang loop vectorize(assume_safety)") for (size_t i = first; i < first + POOL_LANES; ++i)

TRIAD_FUNCTION int wave_any(global const uint* states, uint state) {
    uint any = 0u;
    for (uint i = 0u; i < POOL_LANES; ++i) any |= (uint)(states[i] == state);
    return any != 0u;
}

/* Adds to the film the samples that the work names. */
kernel void trace_wave(SCENE_PARAMETERS PARAMETERS(TRACE_WAVE_LIST)) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    const WaveWork list = {&local_frame, work + first_work, work_count * FILM_TILE_PIXELS,
                           ((ulong)first_sample_high << 32) | first_sample_low};
    const WaveFilm film = {sums, half_sums, samples, first_pixel};
    const size_t item = get_global_id(0);
    if (item >= pool_count) return;
    const Pool pool = pool_at(item, states, pixels, taken, rays, paths, hits, pending, films);
    Tally tally = tally_start();
    WAVE_SLOTS(i) pool.states[i] = WAVE_NEW;
    uint idle;
    do {
        idle = 0u;
        WAVE_SLOTS(i) idle += (uint)wave_end(&scene, &list, &film, &pool, i, next_pixel, &tally);
        WAVE_LANES(i, WAVE_START) { wave_start(&scene, &list, &pool, i); }
        WAVE_SLOTS(i) wave_edge(&scene, &pool, i, &tally);
        WAVE_LANES(i, WAVE_HIT) { wave_vertex(&scene, &pool, i, &tally); }
        WAVE_SLOTS(i) wave_shadow(&scene, &pool, i, &tally);
    } while (idle < POOL_SLOTS);
    tally_add(counters, &tally);
}
