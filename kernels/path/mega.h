/* The driver `mega`: a path is followed from the camera to its end in one loop over the stages. */
#ifndef TRIAD_PATH_MEGA_H
#define TRIAD_PATH_MEGA_H

#include "path/connect.h"
#include "path/emission.h"
#include "path/fork.h"
#include "path/rays.h"
#include "path/survive.h"

/* Where the path's edge ends. camera_hit: of its first edge, if that is known; else null. */
TRIAD_FUNCTION_PER_CALL Hit mega_closest(const Scene* scene, const PathState* path, const Hit* camera_hit,
                                         Tally* tally) {
#if TRIAD_PACKETS
    if (camera_hit != 0 && path->edge == 1u && !path_is_back(path)) return *camera_hit;
#else
    (void)camera_hit;
#endif
    return path_closest(scene, path, tally);
}

/* An edge and the vertex at its end. camera_hit: of mega_closest(). 0: the path ends there. */
TRIAD_FUNCTION_PER_CALL int mega_edge(const Scene* scene, PathState* path, const Hit* camera_hit,
                                      Tally* tally) {
    const SamplerBlock u = path_numbers(path);
    const Hit hit = mega_closest(scene, path, camera_hit, tally);
    if (hit.primitive == TRIAD_NONE) {
        path_miss(scene, path, &hit, tally);
        return 0;
    }
    const LightHit lit = path_lit(scene, path, &hit);
    Vertex vertex = path_surface(scene, path, &hit, tally);
    if (path_unlit(scene, path, &vertex, tally)) return 0;
    path_emission(scene, path, &vertex, lit, tally);
    if (path_is_longest(scene, path)) {
        path_cut(path, tally);
        return 0;
    }

    path_face(scene, path, &vertex);
    path_fork(scene, path, &vertex);
    const LightPick pick = path_pick(scene, path, &vertex, &u);
    const VertexBsdf bsdf = path_bsdf(scene, path, &vertex);
    path_gather(path, path_gathered(scene, path, &vertex, &bsdf));

    PendingLight light;
    if (path_connect(scene, path, &vertex, &bsdf, &u, pick, &light) && !path_occluded(scene, &light, tally))
        path_arrive(scene, path, &light, tally);

    Scatter scatter;
    return path_scatter(scene, path, &vertex, &bsdf, &u, &scatter, tally) &&
           path_survive(scene, path, &vertex, &scatter, &u, tally);
}

/* To the end of a path that has started. */
TRIAD_FUNCTION_PER_CALL void mega_follow(const Scene* scene, PathState* path, const Hit* camera_hit,
                                         Tally* tally) {
    while (mega_edge(scene, path, camera_hit, tally) || path_next_wavelength(path)) {
    }
}

#endif
