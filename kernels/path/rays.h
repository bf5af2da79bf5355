/* Rays of paths against the scene. */
#ifndef TRIAD_PATH_RAYS_H
#define TRIAD_PATH_RAYS_H

#include "path/connect.h"
#include "traversal/traverse.h"

/* name: of the ray, by which the alpha test decides: coverage_ray(). */
TRIAD_FUNCTION Hit rays_closest(const Scene* scene, Ray ray, uint name, Tally* tally) {
    Traversal traversal =
        traversal_make(scene->nodes, scene->blocks, scene->instances, scene->frame->root[TRIAD_BVH4]);
#if TRIAD_ALPHA_TEST
    const Coverage coverage = {scene, name};
    traversal.context = &coverage;
#else
    (void)name;
#endif
#if TRIAD_COUNT_WORK
    traversal.work = &tally->ray;
#endif
    ++tally->rays;
    return traverse_closest(&traversal, ray);
}

TRIAD_FUNCTION int rays_occluded(const Scene* scene, Ray ray, uint name, Tally* tally) {
    Traversal traversal =
        traversal_make(scene->nodes, scene->blocks, scene->instances, scene->frame->root[TRIAD_BVH4]);
#if TRIAD_ALPHA_TEST
    const Coverage coverage = {scene, name};
    traversal.context = &coverage;
#else
    (void)name;
#endif
#if TRIAD_COUNT_WORK
    traversal.work = &tally->ray;
#endif
    ++tally->rays;
    return traverse_occluded(&traversal, ray);
}

/* Where the path's edge ends. */
TRIAD_FUNCTION Hit path_closest(const Scene* scene, const PathState* path, Tally* tally) {
#if PATH_FORKS
    if (path_is_back(path)) return path->fork.hit;
#endif
#if TRIAD_COUNT_WORK
    tally->edge = min(path->edge, (uint)WORK_EDGES) - 1u;
#endif
    const Hit hit = rays_closest(scene, path->ray, path_ray_name(path), tally);
    work_count(tally, path->edge == 1u ? WORK_CAMERA : WORK_BOUNCE);
#if TRIAD_COUNT_WORK
    if (hit.primitive != TRIAD_NONE) atomic_inc(&tally->edges[tally->edge].hits);
#endif
    return hit;
}

/* Whether anything is in the way of the light that a vertex has chosen. */
TRIAD_FUNCTION int path_occluded(const Scene* scene, const PendingLight* light, Tally* tally) {
#if TRIAD_ALPHA_TEST
    const int is_occluded = rays_occluded(scene, light->ray, light->name, tally);
#else
    const int is_occluded = rays_occluded(scene, light->ray, 0u, tally);
#endif
    work_count(tally, WORK_SHADOW);
    return is_occluded;
}

#endif
