/* What paths leave behind beside their light: counts, and, in record.cl alone, what they did at every vertex.
 */
#ifndef TRIAD_PATH_RECORD_H
#define TRIAD_PATH_RECORD_H

#include "common/film.h"
#include "path/state.h"
#include "shading/environment.h"

#ifndef TRIAD_RECORD
#define TRIAD_RECORD 0
#endif
#ifndef TRIAD_COUNT_WORK
#define TRIAD_COUNT_WORK 0
#endif

/* What one work-item counts, in registers, for COUNTER_*. */
typedef struct Tally {
    uint rays, not_finite, saturated, truncated, cut_energy;
#if TRIAD_RECORD
    global PathVertex* path; /* PATH_VERTICES of them */
    uint vertices;
#endif
#if TRIAD_COUNT_WORK
    RayWork ray; /* of the present ray */
    PixelWork work;
    volatile global EdgeWork* edges; /* WORK_EDGES of them, of all items */
    uint edge;                       /* that the last ray followed, or ended at */
#endif
} Tally;

#if TRIAD_COUNT_WORK

TRIAD_FUNCTION RayWork work_none(void) {
    RayWork w;
    w.rays = w.nodes = w.blocks = w.triangles = w.deepest_sum = w.deepest = 0u;
    return w;
}

/* The present ray has been walked. */
TRIAD_FUNCTION void work_count(Tally* t, uint kind) {
    RayWork* sum = &t->work.rays[kind];
    sum->rays += 1u;
    sum->nodes += t->ray.nodes;
    sum->blocks += t->ray.blocks;
    sum->triangles += t->ray.triangles;
    sum->deepest_sum += t->ray.deepest;
    sum->deepest = max(sum->deepest, t->ray.deepest);
    if (kind == WORK_SHADOW)
        atomic_inc(&t->edges[t->edge].shadow_rays);
    else
        atomic_inc(&t->edges[t->edge].rays);
    t->ray = work_none();
}

#else
#define work_count(tally, kind)
#endif

TRIAD_FUNCTION Tally tally_start(void) {
    Tally t;
    t.rays = t.not_finite = t.saturated = t.truncated = t.cut_energy = 0u;
#if TRIAD_RECORD
    t.path = 0; /* record.cl sets it */
    t.vertices = 0u;
#endif
#if TRIAD_COUNT_WORK
    t.ray = work_none();
    for (uint kind = 0u; kind < WORK_KINDS; ++kind) t.work.rays[kind] = work_none();
    t.edge = 0u;
    t.edges = 0; /* count.cl sets it */
#endif
    return t;
}

TRIAD_FUNCTION void tally_add(volatile global uint* counters, const Tally* t) {
    counter_add(counters, COUNTER_RAYS, t->rays);
    counter_add(counters, COUNTER_NOT_FINITE, t->not_finite);
    counter_add(counters, COUNTER_SATURATED, t->saturated);
    counter_add(counters, COUNTER_TRUNCATED, t->truncated);
    counter_add(counters, COUNTER_CUT_ENERGY, t->cut_energy);
}

#if TRIAD_RECORD

/* The present vertex. The last one kept stands for all later ones. */
TRIAD_FUNCTION global PathVertex* record_at(const Tally* t) {
    return t->path + math_min_uint(t->vertices, (uint)PATH_VERTICES) - 1u;
}

/* The path's edge ended here: the first call for a vertex. */
TRIAD_FUNCTION void record_vertex(Tally* t, const PathState* path, Vec3 position, const Hit* hit,
                                  uint material) {
    ++t->vertices;
    global PathVertex* v = record_at(t);
    if (t->vertices <= PATH_VERTICES) {
        vec3_store(vec3_splat(0.0f), v->found, 0);
        vec3_store(vec3_splat(0.0f), v->direct, 0);
        v->light = TRIAD_NONE;
    }
    vec3_store(position, v->position, 0);
    vec3_store(vec3_splat(0.0f), v->throughput, 0);
    v->primitive = hit->primitive;
    v->instance = hit->instance;
    v->material = material;
    v->event = BSDF_NONE;
    v->end = PATH_GOES_ON;
    v->edge = path->edge;
    v->wavelength = path_is_back(path) ? 0.0f : path_wavelength(&path->colours);
}

TRIAD_FUNCTION void record_end(const Tally* t, uint why) { record_at(t)->end = why; }

TRIAD_FUNCTION void record_found(const Tally* t, const PathState* path, Colour radiance) {
    global PathVertex* v = record_at(t);
    vec3_store(vec3_add(VEC3_OF(v->found), path_found(&path->colours, radiance)), v->found, 0);
}

/* From the light that the vertex has chosen. */
TRIAD_FUNCTION void record_direct(const Tally* t, uint light, const PathState* path, Colour radiance) {
    global PathVertex* v = record_at(t);
    v->light = light;
    vec3_store(vec3_add(VEC3_OF(v->direct), path_found(&path->colours, radiance)), v->direct, 0);
}

TRIAD_FUNCTION void record_event(const Tally* t, const PathState* path, uint event) {
    global PathVertex* v = record_at(t);
    v->end = PATH_GOES_ON;
    v->event = event;
    vec3_store(path_found(&path->colours, path->throughput), v->throughput, 0);
}

#else
#define record_vertex(tally, path, position, hit, material) ((void)(tally))
#define record_end(tally, why) ((void)(tally))
#define record_found(tally, path, radiance) ((void)(tally))
#define record_direct(tally, light, path, radiance) ((void)(tally))
#define record_event(tally, path, event) ((void)(tally))
#endif

#endif
