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

TRIAD_FUNCTION global PathVertex* record_at(const Recorder* r, uint edge) {
    return r->path + (edge <= PATH_VERTICES ? edge : PATH_VERTICES) - 1u;
}

/* The edge-th edge ended here: the first call for an edge. The last vertex kept stands for all later ones. */
TRIAD_FUNCTION void record_vertex(Recorder* r, uint edge, float3 position, const Hit* hit, uint material) {
    r->vertices = edge;
    global PathVertex* v = record_at(r, edge);
    if (edge <= PATH_VERTICES) {
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
    v->unused[0] = v->unused[1] = 0u;
}

TRIAD_FUNCTION void record_end(const Recorder* r, uint edge, uint why) { record_at(r, edge)->end = why; }

TRIAD_FUNCTION void record_found(const Recorder* r, uint edge, float3 radiance) {
    global PathVertex* v = record_at(r, edge);
    vstore3(vload3(0, v->found) + radiance, 0, v->found);
}

/* `pick` is the number that light_sample() picked the light with. */
TRIAD_FUNCTION void record_direct(const Recorder* r, uint edge, float3 radiance, const Scene* scene,
                                  uint pick) {
    global PathVertex* v = record_at(r, edge);
    float unused;
    v->light = cdf_find(&scene->frame->lights, scene->light_cdf, pick, &unused, &unused);
    vstore3(vload3(0, v->direct) + radiance, 0, v->direct);
}

TRIAD_FUNCTION void record_event(const Recorder* r, uint edge, uint event, float3 throughput) {
    global PathVertex* v = record_at(r, edge);
    v->event = event;
    vstore3(throughput, 0, v->throughput);
}

#else
#define RECORD(statement)
#endif

#endif
