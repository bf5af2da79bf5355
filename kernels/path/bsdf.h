/* What a vertex does to light, for the path that came along wo. */
#ifndef TRIAD_PATH_BSDF_H
#define TRIAD_PATH_BSDF_H

#include "path/surface.h"

#if PATH_KEEPS_FILMS
/* FilmMeans for the k-th wavelength, or for all of them together. */
TRIAD_FUNCTION global float* path_film_means(const Vertex* vertex, uint k) {
    return vertex->films + k * (POOL_FILM_WORDS / 4u);
}
#endif

/* As the k-th wavelength sees it. */
TRIAD_FUNCTION VertexBsdf path_bsdf_of(const Scene* scene, const Vertex* vertex, float wavelength, uint k) {
    BsdfInput input;
    VertexBsdf v = vertex_seen(scene, &vertex->surface, vertex->wo, vertex->ng, vertex->back,
                               vertex->around.here, vertex->around.beyond, wavelength, &input);
#if PATH_KEEPS_FILMS
    input.has_film_means = 1u;
    input.film_means = path_film_means(vertex, k);
#else
    (void)k;
#endif
    v.bsdf = bsdf_make(&input, v.wo, scene->albedo);
    return v;
}

/* After path_fork(). */
TRIAD_FUNCTION VertexBsdf path_bsdf(const Scene* scene, PathState* path, Vertex* vertex) {
    const VertexBsdf v = path_bsdf_of(scene, vertex, path_wavelength(&path->colours), 0u);
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
        const VertexBsdf v = path_bsdf_of(scene, vertex, waiting.x, i);
        float density = 0.0f;
        const Colour f = bsdf_eval(&v.bsdf, v.wo, wi, &density);
        waiting = vec4_push(waiting, 0.0f);
        value = vec4_push(value, i == 0u ? f.x : i == 1u ? f.y : i == 2u ? f.z : f.w);
        *densities = vec4_push(*densities, density);
    }
    return value;
}
#endif

#if PATH_KEEPS_FILMS
TRIAD_FUNCTION void path_keep_film(const Scene* scene, const Vertex* vertex, float wavelength, uint k) {
    BsdfInput input;
    const VertexBsdf v = vertex_seen(scene, &vertex->surface, vertex->wo, vertex->ng, vertex->back,
                                     vertex->around.here, vertex->around.beyond, wavelength, &input);
    const FilmMeans means = base_film_means(&input, v.wo);
    colour_store(means.mean, path_film_means(vertex, k), 0u);
    colour_store(means.rise, path_film_means(vertex, k), 1u);
}
/* What path_bsdf() and path_eval() need. */
TRIAD_FUNCTION void path_keep_films(const Scene* scene, const PathState* path, const Vertex* vertex) {
    if (!(vertex->surface.film > 0.0f)) return;
#if PATH_EACH
    const uint each =
        vertex_disperses(scene, &vertex->surface, &vertex->around) && path_has_others(&path->colours);
    Vec4 waiting = path_wavelengths(&path->colours);
    for (uint k = 0u; k < (each ? 4u : 1u); ++k) {
        path_keep_film(scene, vertex, waiting.x, k);
        waiting = vec4_push(waiting, 0.0f);
    }
#else
    path_keep_film(scene, vertex, path_wavelength(&path->colours), 0u);
#endif
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
