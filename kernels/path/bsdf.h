/* What a vertex does to light, for the path that came along wo. */
#ifndef TRIAD_PATH_BSDF_H
#define TRIAD_PATH_BSDF_H

#include "path/surface.h"

/* After path_fork(). */
TRIAD_FUNCTION VertexBsdf path_bsdf(const Scene* scene, PathState* path, Vertex* vertex) {
    const VertexBsdf v =
        vertex_bsdf(scene, &vertex->surface, vertex->wo, vertex->ng, vertex->back, vertex->around.here,
                    vertex->around.beyond, path_wavelength(&path->colours));
#if PATH_EACH
    vertex->each =
        vertex_disperses(scene, &vertex->surface, &vertex->around) && path_has_others(&path->colours);
    if (vertex->each && bsdf_is_smooth(&v.bsdf)) {
        path_end_others(&path->colours, &path->throughput);
        vertex->each = 0;
    }
#endif
    return v;
}

#if PATH_EACH
/* The value at each wavelength with that wavelength's index, and the densities of wi were each the first. */
TRIAD_FUNCTION_ONCE Colour path_eval_each(const Scene* scene, Vec4 wavelengths, const Vertex* vertex, Vec3 wi,
                                          Vec4* densities) {
    Vec4 waiting = wavelengths, value = vec4_splat(0.0f);
    *densities = vec4_splat(0.0f);
    for (uint i = 0u; i < 4u; ++i) {
        const VertexBsdf v = vertex_bsdf(scene, &vertex->surface, vertex->wo, vertex->ng, vertex->back,
                                         vertex->around.here, vertex->around.beyond, waiting.x);
        float density = 0.0f;
        const Colour f = bsdf_eval(&v.bsdf, v.wo, wi, &density);
        waiting = vec4_push(waiting, 0.0f);
        value = vec4_push(value, i == 0u ? f.x : i == 1u ? f.y : i == 2u ? f.z : f.w);
        *densities = vec4_push(*densities, density);
    }
    return value;
}
#endif

/* f |cos wi| at the path's wavelengths, and the density with which path_scatter() draws wi; delta lobes
 * excluded. wi: in the frame of v. */
TRIAD_FUNCTION Colour path_eval(const Scene* scene, const PathState* path, const Vertex* vertex,
                                const VertexBsdf* v, Vec3 wi, float* density) {
#if PATH_EACH
    if (vertex->each) {
        Vec4 densities;
        const Colour f = path_eval_each(scene, path_wavelengths(&path->colours), vertex, wi, &densities);
        *density = path_mean_density(&path->colours, densities);
        return f;
    }
#else
    (void)scene, (void)path, (void)vertex;
#endif
    return bsdf_eval(&v->bsdf, v->wo, wi, density);
}

#endif
