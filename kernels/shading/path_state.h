/* A path as it stands at the start of an edge: what it takes to go on from there. */
#ifndef TRIAD_SHADING_PATH_STATE_H
#define TRIAD_SHADING_PATH_STATE_H

#include "common/colour.h"
#include "shading/path_colour.h"
#include "shading/vertex.h"

typedef struct PathState {
    Ray ray;
    Colour throughput;
    uint edge; /* the camera's ray is edge 1 */
    /* solid-angle density of the direction; 0: delta or camera, found by no other sampling */
    float pdf;
    float body_scale; /* factor of throughput that leaving the bodies around will undo: no reason to die */
    int straight;     /* only transmissions so far: the camera looks through */
    int specular;     /* only delta events so far */
    Bodies bodies;    /* that the path is in */
#if TRIAD_TRANSMISSION
    float3 from; /* of the edge, before any offset */
#endif
#if TRIAD_PHOTONS
    int caustic; /* one event that is no delta event, and then delta events only: photons bring this light */
#endif
} PathState;

TRIAD_FUNCTION PathState path_start(Ray ray) {
    PathState p;
    p.ray = ray;
    p.throughput = (Colour)(1.0f);
    p.edge = 1u;
    p.pdf = 0.0f;
    p.body_scale = 1.0f;
    p.straight = p.specular = 1;
    p.bodies = (Bodies)(TRIAD_NONE);
#if TRIAD_TRANSMISSION
    p.from = (float3)(ray.origin[0], ray.origin[1], ray.origin[2]);
#endif
#if TRIAD_PHOTONS
    p.caustic = 0;
#endif
    return p;
}

/* From its first dispersive surface on a path is followed with PATH_WAVELENGTHS wavelengths, one after the
 * other. */
#define PATH_FORKS (!TRIAD_HERO && TRIAD_DISPERSION && TRIAD_TRANSMISSION)
#if PATH_FORKS

typedef struct PathFork {
    PathState path; /* before the edge that ends at that surface */
    Hit hit;
    uint branch; /* how many wavelengths are done */
} PathFork;

TRIAD_FUNCTION PathFork path_fork_start(PathState path) {
    PathFork f;
    f.path = path;
    f.hit.primitive = TRIAD_NONE;
    f.branch = 0u;
    return f;
}

/* Whether the path is about to look at that surface once more. */
TRIAD_FUNCTION int path_is_at_fork(const PathFork* fork, const PathState* path) {
    return fork->branch != 0u && path->edge == fork->path.edge;
}

/* Random numbers of the branch-th wavelength: the first goes on with those of the path. */
TRIAD_FUNCTION Sampler path_branch_sampler(const Sampler* sampler, uint branch) {
    Sampler s = *sampler;
    if (branch != 0u) s.key0 = random_mix(s.key0 + branch);
    return s;
}

/* After a path ended: back to where it forked, if wavelengths are left. */
TRIAD_FUNCTION int path_next_branch(PathFork* fork, PathState* path, const PathColour* colours) {
    if (colours->share == 1.0f || ++fork->branch == PATH_WAVELENGTHS) return 0;
    *path = fork->path;
    return 1;
}

#else
#define path_next_branch(fork, path, colours) 0
#endif

#endif
