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
    if (vertex->each && v.bsdf.smooth) {
        path_end_others(&path->colours, &path->throughput);
        vertex->each = 0;
    }
#endif
    return v;
}

#if PATH_EACH
/* The value at each wavelength with that wavelength's index, and the densities of wi were each the first. */
TRIAD_FUNCTION_ONCE Colour path_eval_each_once(const Scene* scene, const PathColour* c, const Surface* s,
                                               float3 wo, float3 ng, int back, Bodies here, Bodies beyond,
                                               float3 wi, float4* densities) {
    float wavelengths[4], values[4], value[4], density[4];
    vstore4(c->wavelengths, 0, wavelengths);
    for (uint i = 0u; i < 4u; ++i) {
        const VertexBsdf v = vertex_bsdf(scene, s, wo, ng, back, here, beyond, wavelengths[i]);
        density[i] = 0.0f;
        const Colour f = bsdf_eval(&v.bsdf, v.wo, wi, &density[i]);
        vstore4(f, 0, values);
        value[i] = values[i];
    }
    *densities = vload4(0, density);
    return vload4(0, value);
}
TRIAD_FUNCTION Colour path_eval_each(const Scene* scene, const PathState* path, const Vertex* vertex,
                                     float3 wi, float4* densities) {
    /* copies: what a call is given an address of does not stay in registers */
    const Surface surface = vertex->surface;
    const PathColour colours = path->colours;
    return path_eval_each_once(scene, &colours, &surface, vertex->wo, vertex->ng, vertex->back,
                               vertex->around.here, vertex->around.beyond, wi, densities);
}
#endif

/* f |cos wi| at the path's wavelengths, and the density with which path_scatter() draws wi; delta lobes
 * excluded. wi: in the frame of v. */
TRIAD_FUNCTION Colour path_eval(const Scene* scene, const PathState* path, const Vertex* vertex,
                                const VertexBsdf* v, float3 wi, float* density) {
#if PATH_EACH
    if (vertex->each) {
        float4 densities;
        const Colour f = path_eval_each(scene, path, vertex, wi, &densities);
        *density = path_mean_density(&path->colours, densities);
        return f;
    }
#else
    (void)scene, (void)path, (void)vertex;
#endif
    return bsdf_eval(&v->bsdf, v->wo, wi, density);
}

#endif
