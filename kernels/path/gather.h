/* Stage `gather`: light that photons have brought to where the path is. */
#ifndef TRIAD_PATH_GATHER_H
#define TRIAD_PATH_GATHER_H

#include "path/surface.h"
#include "shading/photon_map.h"

/* PHOTON_MAP_*, or 0: paths gather no photons. */
TRIAD_FUNCTION uint path_map_use(const Scene* scene) {
#if PATH_GATHERS
    return scene->frame->photon_map;
#else
    (void)scene;
    return 0u;
#endif
}

/* Whether light that the path runs into is left out, where it comes from a light of photons: these bring it.
 */
TRIAD_FUNCTION int path_leaves_to_photons(const Scene* scene, const PathState* path) {
#if TRIAD_PHOTONS
    if (scene->frame->photons && path->pdf == 0.0f)
        return path_map_use(scene) ? !(path->traits & PATH_SPECULAR) : (path->traits & PATH_CAUSTIC) != 0u;
#else
    (void)scene, (void)path;
#endif
    return 0;
}

/* Whether the photons here bring all light, also what light sampling would. */
TRIAD_FUNCTION int path_ends_in_map(const Scene* scene, const PathState* path) {
    return path_map_use(scene) == PHOTON_MAP_FINAL_GATHER && !(path->traits & PATH_SPECULAR);
}

/* What the path finds there of it, to be multiplied with its throughput. */
TRIAD_FUNCTION Colour path_gathered(const Scene* scene, const PathState* path, const Vertex* vertex,
                                    const VertexBsdf* v) {
#if PATH_GATHERS
    global const Frame* frame = scene->frame;
    const uint use = frame->photon_map, specular = path->traits & PATH_SPECULAR;
    if (use == 0u || !bsdf_has_smooth(&v->bsdf)) return colour_splat(0.0f);
    if (use == PHOTON_MAP_PROGRESSIVE && path->edge == 1u)
        return colour_splat(0.0f); /* splatted: photon_splat.h */
    PhotonQuery q;
    q.position = vertex->surface.position;
    q.normal = vertex->ng;
    q.most_edges = frame->max_depth == 0u ? 0u : frame->max_depth - path->edge;
    q.which = use == PHOTON_MAP_VISUALISED                  ? PHOTON_INDIRECT
              : use == PHOTON_MAP_FINAL_GATHER && !specular ? PHOTON_ANY
                                                            : PHOTON_CAUSTIC;
    q.radius = specular && use != PHOTON_MAP_VISUALISED ? scene->photon_map->sharp_radius
                                                        : scene->photon_map->radius;
    q.wavelength = path_wavelength(&path->colours);
    return photon_gather(scene, &q, v);
#else
    (void)scene, (void)path, (void)vertex, (void)v;
    return colour_splat(0.0f);
#endif
}
TRIAD_FUNCTION void path_gather(PathState* path, Colour gathered) {
#if PATH_GATHERS
    path->radiance = colour_add(path->radiance, colour_mul(path->throughput, gathered));
#else
    (void)path, (void)gathered;
#endif
}

#endif
