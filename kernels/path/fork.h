/* Dispersion: where a path meets the first surface that tells wavelengths apart, it forks. One wavelength
 * after the other is followed from there to its end, and all are summed before the sample is rounded. */
#ifndef TRIAD_PATH_FORK_H
#define TRIAD_PATH_FORK_H

#include "path/surface.h"

/* After path_surface(): at such a surface the path goes on with its next wavelength. */
TRIAD_FUNCTION void path_fork(const Scene* scene, PathState* path, const Vertex* vertex) {
#if PATH_FORKS
    PathFork* fork = &path->fork;
    if (!path_is_back(path)) {
        if (path_wavelength(&path->colours) != 0.0f ||
            !vertex_disperses(scene, &vertex->surface, &vertex->around))
            return;
        fork->edge = path->edge;
        fork->hit = vertex->hit;
        for (uint axis = 0u; axis < 3u; ++axis) fork->direction[axis] = path->ray.direction[axis];
        fork->traits = path->traits;
        fork->throughput = path->throughput;
        fork->pdf = path->pdf;
        fork->body_scale = path->body_scale;
        fork->bodies = path->bodies;
    }
    const Sampler sampler = path->sampler; /* a copy: see state.h */
    path_draw_wavelength(&path->colours, scene, &sampler, fork->branch, &path->radiance);
#else
    (void)scene, (void)path, (void)vertex;
#endif
}

/* After the path has ended: back to where it forked, if wavelengths are left. */
TRIAD_FUNCTION int path_next_wavelength(PathState* path) {
#if PATH_FORKS
    PathFork* fork = &path->fork;
    if (fork->edge == 0u || ++fork->branch == PATH_WAVELENGTHS) return 0;
    path->edge = fork->edge;
    for (uint axis = 0u; axis < 3u; ++axis) path->ray.direction[axis] = fork->direction[axis];
    path->traits = fork->traits;
    path->throughput = fork->throughput;
    path->pdf = fork->pdf;
    path->body_scale = fork->body_scale;
    path->bodies = fork->bodies;
    return 1;
#else
    (void)path;
    return 0;
#endif
}

#endif
