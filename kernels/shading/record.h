/* What a path did, written down: only record.cl turns it on; in every other program RECORD() is nothing. */
#ifndef TRIAD_SHADING_RECORD_H
#define TRIAD_SHADING_RECORD_H

#include "shading/environment.h"

#ifndef TRIAD_RECORD
#define TRIAD_RECORD 0
#endif

#if TRIAD_RECORD
#define RECORD(statement) statement

typedef struct Recorder {
    global PathVertex* path; /* PATH_VERTICES of them */
    uint vertices;
} Recorder;

/* The present vertex. The last one kept stands for all later ones. */
TRIAD_FUNCTION global PathVertex* record_at(const Recorder* r) {
    return r->path + min(r->vertices, (uint)PATH_VERTICES) - 1u;
}

/* The edge-th edge ended here: the first call for a vertex. */
TRIAD_FUNCTION void record_vertex(Recorder* r, uint edge, float wavelength, float3 position, const Hit* hit,
                                  uint material) {
    ++r->vertices;
    global PathVertex* v = record_at(r);
    if (r->vertices <= PATH_VERTICES) {
        vstore3((float3)(0.0f), 0, v->found);
        vstore3((float3)(0.0f), 0, v->direct);
        v->light = TRIAD_NONE;
    }
    vstore3(position, 0, v->position);
    vstore3((float3)(0.0f), 0, v->throughput);
    v->primitive = hit->primitive;
    v->instance = hit->instance;
    v->material = material;
    v->event = BSDF_NONE;
    v->end = PATH_GOES_ON;
    v->edge = edge;
    v->wavelength = wavelength;
}

TRIAD_FUNCTION void record_end(const Recorder* r, uint why) { record_at(r)->end = why; }

TRIAD_FUNCTION void record_found(const Recorder* r, float3 radiance) {
    global PathVertex* v = record_at(r);
    vstore3(vload3(0, v->found) + radiance, 0, v->found);
}

/* `pick` is the number that light_sample() picked the light with. */
TRIAD_FUNCTION void record_direct(const Recorder* r, float3 radiance, const Scene* scene, uint pick) {
    global PathVertex* v = record_at(r);
    float unused;
    v->light = cdf_find(&scene->frame->lights, scene->light_cdf, pick, &unused, &unused);
    vstore3(vload3(0, v->direct) + radiance, 0, v->direct);
}

TRIAD_FUNCTION void record_event(const Recorder* r, uint event, float3 throughput) {
    global PathVertex* v = record_at(r);
    v->event = event;
    vstore3(throughput, 0, v->throughput);
}

#else
#define RECORD(statement)
#endif

#endif
