/* What a slot of the pool does in each stage of a round. */
#ifndef TRIAD_PATH_WAVE_STAGES_H
#define TRIAD_PATH_WAVE_STAGES_H

#include "path/add.h"
#include "path/emission.h"
#include "path/fork.h"
#include "path/rays.h"
#include "path/survive.h"
#include "path/wave.h"

/* The list of work of a launch. */
typedef struct WaveWork {
    const Frame* frame;
    global const TileWork* tiles;
    uint pixel_count; /* of all tiles */
    ulong first_sample;
} WaveWork;

/* The pixel of a slot. */
typedef struct WavePixel {
    uint x, y, count; /* samples that it is given */
    ulong first;      /* the first of them */
} WavePixel;

/* 0: it lies outside the crop, or is given no samples. */
TRIAD_FUNCTION int wave_pixel(const WaveWork* work, uint pixel, WavePixel* p) {
    const global TileWork* tile = work->tiles + pixel / FILM_TILE_PIXELS;
    const uint in_tile = pixel % FILM_TILE_PIXELS;
    const int inside = sample_pixel(work->frame->crop, tile->tile * FILM_TILE_PIXELS + in_tile, &p->x, &p->y);
    const uint set = (p->x ^ p->y) & 1u;
    p->count = tile->sample_count[set];
    p->first = work->first_sample + tile->first_sample[set];
    return inside && p->count != 0u;
}

/* Samples become paths. */
TRIAD_FUNCTION_PER_CALL void wave_start(const Scene* scene, const WaveWork* work, const Pool* pool,
                                        size_t i) {
    if (pool->states[i] == WAVE_START) {
        WavePixel p;
        wave_pixel(work, pool->pixels[i], &p);
        const CameraSample sample = camera_sample(scene, work->frame, p.x, p.y, p.first + pool->taken[i]);
        PathState path = path_start(scene, &sample);
        POOL_STORE(path, pool->paths, &path);
        pool->states[i] = WAVE_EDGE;
    }
}

/* Where edges end. */
TRIAD_FUNCTION_PER_CALL void wave_edge(const Scene* scene, const Pool* pool, size_t i, Tally* tally) {
    if (pool->states[i] == WAVE_EDGE) {
        PathState path;
        POOL_LOAD(path, pool->paths, &path);
        Hit hit = path_closest(scene, &path, tally);
        POOL_STORE(hit, pool->hits, &hit);
        pool->states[i] = hit.primitive == TRIAD_NONE ? WAVE_MISS : WAVE_HIT;
    }
}

/* Parts of a path that change at a vertex: while the path finds things there, and when it goes on. */
#define PARTS_MEET (PART_TRAITS | PART_LOAD | PART_FROM | PART_COLOURS | PART_FOUND | PART_FORK)
#define PARTS_SCATTER (PART_EDGE | PART_TRAITS | PART_LOAD | (PATH_EACH ? PART_COLOURS : 0u))

/* The path is at the end of its edge: whether it ends there, WAVE_END, or is to go on, WAVE_GO. */
TRIAD_FUNCTION_PER_CALL uint vertex_meet(const Scene* scene, PathState* path, const Vertex* vertex,
                                         LightHit lit, Tally* tally) {
    uint state = WAVE_END;
    if (!path_unlit(scene, path, vertex, tally)) {
        path_emission(scene, path, vertex, lit, tally);
        if (path_is_longest(scene, path)) {
            state = WAVE_END | WAVE_LONGEST;
        } else {
            path_face(scene, path, vertex);
            path_fork(scene, path, vertex);
            state = WAVE_GO;
        }
    }
    return state;
}

/* WAVE_LIGHT: the slot has a light to be seen. */
TRIAD_FUNCTION_PER_CALL uint vertex_connect(const Scene* scene, const Pool* pool, size_t i,
                                            const PathState* path, const Vertex* vertex,
                                            const VertexBsdf* bsdf, const SamplerBlock* u, LightPick pick) {
    PendingLight light;
    if (!path_connect(scene, path, vertex, bsdf, u, pick, &light)) return 0u;
    POOL_STORE(light, pool->pending, &light);
    return WAVE_LIGHT;
}

TRIAD_FUNCTION_PER_CALL uint vertex_scatter(const Scene* scene, PathState* path, const Vertex* vertex,
                                            const VertexBsdf* bsdf, const SamplerBlock* u, Tally* tally) {
    Scatter scatter;
    return path_scatter(scene, path, vertex, bsdf, u, &scatter, tally) &&
                   path_survive(scene, path, vertex, &scatter, u, tally)
               ? WAVE_EDGE
               : WAVE_END;
}

/* What paths find and do at the ends of their edges. */
TRIAD_FUNCTION_PER_CALL void wave_vertex(const Scene* scene, const Pool* pool, size_t i, Tally* tally) {
    if (pool->states[i] == WAVE_HIT) {
        PathState path;
        Hit hit;
        POOL_LOAD(path, pool->paths, &path);
        POOL_LOAD(hit, pool->hits, &hit);
        const SamplerBlock u = path_numbers(&path);
        const LightHit lit = path_lit(scene, &path, &hit);
        Vertex vertex = path_surface(scene, &path, &hit, tally);
        uint state = vertex_meet(scene, &path, &vertex, lit, tally);
        if (state == WAVE_GO) {
            const LightPick pick = path_pick(scene, &path, &vertex, &u);
            const VertexBsdf bsdf = path_bsdf(scene, &path, &vertex);
            path_gather(&path, path_gathered(scene, &path, &vertex, &bsdf));
            state = vertex_connect(scene, pool, i, &path, &vertex, &bsdf, &u, pick);
            state |= vertex_scatter(scene, &path, &vertex, &bsdf, &u, tally);
        }
        POOL_STORE_PARTS(path, pool->paths, &path, PARTS_MEET | PART_FORKED | PARTS_SCATTER);
        pool->states[i] = state;
    }
}

/* The same in four stages. Each looks at the surface again: that takes less than to keep it. */
TRIAD_FUNCTION_PER_CALL void wave_meet(const Scene* scene, const Pool* pool, size_t i, Tally* tally) {
    if (pool->states[i] == WAVE_HIT) {
        PathState path;
        Hit hit;
        POOL_LOAD_PARTS(path, pool->paths, &path, PART_ALL & ~PART_FORKED);
        POOL_LOAD(hit, pool->hits, &hit);
        const LightHit lit = path_lit(scene, &path, &hit);
        const Vertex vertex = path_surface(scene, &path, &hit, tally);
        pool->states[i] = vertex_meet(scene, &path, &vertex, lit, tally);
        POOL_STORE_PARTS(path, pool->paths, &path, PARTS_MEET);
#if PATH_FORKS
        if (path.fork.edge == path.edge && path.fork.branch == 0u)
            POOL_STORE_PARTS(path, pool->paths, &path, PART_FORKED);
#endif
    }
}

#if PATH_KEEPS_FILMS
#define WAVE_FILMS vertex.films = pool->films + i * POOL_FILM_WORDS;
#else
#define WAVE_FILMS
#endif
#define WAVE_AT_VERTEX                             \
    PathState path;                                \
    Hit hit;                                       \
    POOL_LOAD(path, pool->paths, &path);           \
    POOL_LOAD(hit, pool->hits, &hit);              \
    const SamplerBlock u = path_numbers(&path);    \
    Vertex vertex = path_look(scene, &path, &hit); \
    WAVE_FILMS

/* What films over rough surfaces reflect in the mean takes long to find, and two stages need it. */
TRIAD_FUNCTION_PER_CALL void wave_films(const Scene* scene, const Pool* pool, size_t i) {
#if PATH_KEEPS_FILMS
    if (pool->states[i] == WAVE_GO) {
        WAVE_AT_VERTEX(void) u;
        path_keep_films(scene, &path, &vertex);
    }
#else
    (void)scene, (void)pool, (void)i;
#endif
}

TRIAD_FUNCTION_PER_CALL void wave_gather(const Scene* scene, const Pool* pool, size_t i) {
    if (pool->states[i] == WAVE_GO) {
        WAVE_AT_VERTEX(void) u;
        const VertexBsdf bsdf = path_bsdf(scene, &path, &vertex);
        const Colour gathered = path_gathered(scene, &path, &vertex, &bsdf);
        POOL_LOAD(path, pool->paths, &path);
        path_gather(&path, gathered);
        POOL_STORE_PARTS(path, pool->paths, &path, PART_FOUND);
    }
}

TRIAD_FUNCTION_PER_CALL void wave_connect(const Scene* scene, const Pool* pool, size_t i) {
    if (pool->states[i] == WAVE_GO) {
        WAVE_AT_VERTEX
        const LightPick pick = path_pick(scene, &path, &vertex, &u);
        const VertexBsdf bsdf = path_bsdf(scene, &path, &vertex);
        pool->states[i] = WAVE_GO | vertex_connect(scene, pool, i, &path, &vertex, &bsdf, &u, pick);
    }
}

TRIAD_FUNCTION_PER_CALL void wave_scatter(const Scene* scene, const Pool* pool, size_t i, Tally* tally) {
    const uint state = pool->states[i];
    if ((state & ~WAVE_LIGHT) == WAVE_GO) {
        WAVE_AT_VERTEX
        const VertexBsdf bsdf = path_bsdf(scene, &path, &vertex);
        pool->states[i] = (state & WAVE_LIGHT) | vertex_scatter(scene, &path, &vertex, &bsdf, &u, tally);
        POOL_STORE_PARTS(path, pool->paths, &path, PARTS_SCATTER);
    }
}

/* The light of vertices arrives where nothing is in its way. */
TRIAD_FUNCTION_PER_CALL void wave_shadow(const Scene* scene, const Pool* pool, size_t i, Tally* tally) {
    if (pool->states[i] & WAVE_LIGHT) {
        pool->states[i] &= ~WAVE_LIGHT;
        PendingLight light;
        POOL_LOAD(light, pool->pending, &light);
        if (!path_occluded(scene, &light, tally)) {
            PathState path;
            POOL_LOAD(path, pool->paths, &path);
            path_arrive(scene, &path, &light, tally);
            POOL_STORE_PARTS(path, pool->paths, &path, PART_FOUND);
        }
    }
}

/* Where samples go. */
typedef struct WaveFilm {
    global long *sums, *half_sums; /* of the pixels from first_pixel on */
    global uint* samples;
    uint first_pixel;
} WaveFilm;

TRIAD_FUNCTION_PER_CALL void wave_add(const Scene* scene, const WaveWork* work, const WaveFilm* film,
                                      const WavePixel* p, uint had, const PathState* path, Tally* tally) {
    const Frame* frame = work->frame;
    const CameraSample sample = camera_sample(scene, frame, p->x, p->y, p->first + had);
    const size_t pixel = (size_t)p->y * frame->crop[2] + p->x - film->first_pixel;
    film_add(frame, film->sums + pixel * frame->bins[0] * frame->bins[1] * FILM_CHANNELS,
             film->half_sums + pixel * 3, &sample.name, path_value(path, sample.weight), tally);
}

/* Paths that have ended go on with another wavelength, or to the film. next: pixel of the list. 1: the slot
 * has nothing to do any more. */
TRIAD_FUNCTION_PER_CALL int wave_end(const Scene* scene, const WaveWork* work, const WaveFilm* film,
                                     const Pool* pool, size_t i, volatile global uint* next, Tally* tally) {
    uint state = pool->states[i];
    int wants_pixel = state == WAVE_NEW;
    if (state == WAVE_MISS || (state & ~WAVE_LONGEST) == WAVE_END) {
        PathState path;
        POOL_LOAD(path, pool->paths, &path);
        if (state & WAVE_LONGEST) path_cut(&path, tally);
        if (state == WAVE_MISS) {
            Hit hit;
            hit.primitive = TRIAD_NONE;
            path_miss(scene, &path, &hit, tally);
        }
        if (path_next_wavelength(&path)) {
            POOL_STORE(path, pool->paths, &path);
            state = WAVE_EDGE;
        } else {
            WavePixel p;
            wave_pixel(work, pool->pixels[i], &p);
            const uint had = pool->taken[i];
            wave_add(scene, work, film, &p, had, &path, tally);
            pool->taken[i] = had + 1u;
            state = WAVE_START;
            wants_pixel = had + 1u == p.count;
        }
    }
    while (wants_pixel) {
        const uint pixel = atomic_inc(next);
        WavePixel p;
        if (pixel >= work->pixel_count) {
            state = WAVE_IDLE;
            wants_pixel = 0;
        } else if (wave_pixel(work, pixel, &p)) {
            film->samples[(size_t)p.y * work->frame->crop[2] + p.x] += p.count;
            pool->pixels[i] = pixel;
            pool->taken[i] = 0u;
            state = WAVE_START;
            wants_pixel = 0;
        }
    }
    pool->states[i] = state;
    return state == WAVE_IDLE;
}

#endif
