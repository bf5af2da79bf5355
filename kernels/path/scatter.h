/* Stage `scatter`: where a path goes on from a vertex. */
#ifndef TRIAD_PATH_SCATTER_H
#define TRIAD_PATH_SCATTER_H

#include "path/bsdf.h"
#include "path/gather.h"

/* A direction in which a path can go on from a vertex. */
typedef struct Scatter {
    BsdfSample sample; /* of the local frame */
    Vec3 direction;
    float side; /* cosine at the surface: below 0 beyond it */
} Scatter;

/* 0: none was sampled, or one that shading normals do not allow. */
TRIAD_FUNCTION int scatter_sample(const Vertex* vertex, const VertexBsdf* v, const SamplerBlock* u,
                                  Scatter* scatter) {
    scatter->sample = bsdf_sample(&v->bsdf, v->wo, random_float(u->set[1].x), random_point(u->set[0]));
    if (scatter->sample.event == BSDF_NONE) return 0;
    scatter->direction = frame_to_world(&v->frame, scatter->sample.wi);
    scatter->side = vec3_dot(scatter->direction, vertex->ng);
    return scatter->side * scatter->sample.wi.z > 0.0f;
}

/* Into the bodies beyond the surface, or back into those here. */
TRIAD_FUNCTION void scatter_bodies(PathState* path, const Vertex* vertex, uint event) {
#if TRIAD_TRANSMISSION
    if (event & BSDF_TRANSMIT) path->bodies = vertex->around.beyond;
#else
    (void)path, (void)vertex, (void)event;
#endif
}

TRIAD_FUNCTION uint scatter_traits(uint traits, uint edge, uint event) {
    if (!(event & BSDF_TRANSMIT) || (event & (BSDF_DIFFUSE | BSDF_CLOUDED))) traits &= ~PATH_STRAIGHT;
    if (!(event & BSDF_DELTA)) traits &= ~PATH_SPECULAR;
#if TRIAD_PHOTONS
    const int delta = (event & BSDF_DELTA) != 0u,
              caustic = edge == 1u ? !delta : delta && (traits & PATH_CAUSTIC);
    traits = caustic ? traits | PATH_CAUSTIC : traits & ~PATH_CAUSTIC;
#else
    (void)edge;
#endif
    return traits;
}

/* 0: the path is absorbed. */
TRIAD_FUNCTION int path_scatter(const Scene* scene, PathState* path, const Vertex* vertex,
                                const VertexBsdf* v, const SamplerBlock* u, Scatter* scatter, Tally* tally) {
    record_end(tally, PATH_ABSORBED);
    if (!scatter_sample(vertex, v, u, scatter)) return 0;
    const uint event = scatter->sample.event;
    if (!(event & BSDF_DELTA) &&
        (path_ends_in_map(scene, path) || path_map_use(scene) == PHOTON_MAP_VISUALISED))
        return 0;
    Colour weight = scatter->sample.weight;
    float density = scatter->sample.pdf;
#if PATH_EACH
    if (vertex->each) {
        Vec4 densities;
        weight =
            path_eval_each(scene, path_wavelengths(&path->colours), vertex, scatter->sample.wi, &densities);
        density = path_mean_density(&path->colours, densities);
        if (!(density > 0.0f)) return 0;
        weight = colour_scale(weight, 1.0f / density);
        path->colours.share = vec4_mul(path->colours.share, vec4_div(densities, vec4_splat(density)));
    }
#endif
    path->throughput = colour_mul(path->throughput, weight);
#if BSDF_TRANSMISSION
    if ((event & BSDF_TRANSMIT) && !(event & BSDF_DIFFUSE)) path->body_scale *= bsdf_body_scale(&v->bsdf);
#endif
    scatter_bodies(path, vertex, event);
    path->pdf = (event & BSDF_DELTA) ? 0.0f : density;
    path->traits = scatter_traits(path->traits, path->edge, event);
    return 1;
}

#endif
