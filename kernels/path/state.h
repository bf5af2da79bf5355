/* A path as it stands at the start of an edge: what it takes to go on from there, and what it has found so
 * far. Everything else can be had again: random numbers are a function of the sample's name and the edge, the
 * surface of the hit.
 *
 * In drivers that follow a path in one loop the state dissolves into registers, as long as no function that
 * is not copied into its caller is given an address of it or of a member: such calls get copies. */
#ifndef TRIAD_PATH_STATE_H
#define TRIAD_PATH_STATE_H

#include "path/colour.h"
#include "shading/coverage.h"
#include "shading/facing.h"
#include "shading/light_tree.h"

/* What a path has been so far. */
#define PATH_STRAIGHT 1u /* only transmissions: the camera looks through */
#define PATH_SPECULAR 2u /* only delta events */
#define PATH_CAUSTIC 4u  /* one event that is no delta event, and then delta events only: photons' light */

/* traits above, without a light tree: Receiver.facing at the last vertex, by path_face(). */
#define PATH_FACING_SHIFT 16

/* From its first dispersive surface on a path is followed with PATH_WAVELENGTHS wavelengths, one after the
 * other. */
#define PATH_FORKS (!TRIAD_HERO && TRIAD_DISPERSION && TRIAD_TRANSMISSION)
#if PATH_FORKS
/* The path as it arrived at that surface, by the edge-th edge. */
typedef struct PathFork {
    uint branch; /* how many wavelengths are done */
    uint edge;   /* 0: there was no such surface yet */
    Hit hit;
    float direction[3]; /* of the edge */
    uint traits;
    Colour throughput;
    float pdf;
    float body_scale;
    Bodies bodies;
} PathFork;
#endif

typedef struct PathState {
    Sampler sampler; /* what the sample's random numbers are drawn by: path_numbers() */
    Ray ray;         /* the edge */
    uint edge;       /* its number: the camera's ray is edge 1 */
    uint traits;     /* PATH_STRAIGHT, PATH_SPECULAR, PATH_CAUSTIC; PATH_FACING_SHIFT */
    float pdf;       /* solid-angle density of the direction; 0: delta or camera, found by no other sampling;
                        photons: infinite */
#if TRIAD_LIGHT_TREE
    Vec3 normal; /* of the Receiver at the last vertex: path_face() */
#endif
    Colour throughput;
#if TRIAD_TRANSMISSION
    float body_scale; /* factor of throughput that leaving the bodies around will undo: no reason to die */
    Bodies bodies;    /* that the path is in */
    Vec3 from;        /* where the edge starts, before any offset: what bodies absorb goes by its length */
#endif
    Colour radiance; /* that was found; with one wavelength: since it was drawn */
    float alpha;
    PathColour colours;
#if PATH_FORKS
    PathFork fork;
#endif
} PathState;

/* The first edge, with all wavelengths. */
TRIAD_FUNCTION PathState path_state(const Sampler* sampler, Ray ray, PathColour colours) {
    PathState p;
    p.sampler = *sampler;
    p.ray = ray;
    p.edge = 1u;
    p.traits = PATH_STRAIGHT | PATH_SPECULAR;
    p.pdf = 0.0f;
#if TRIAD_LIGHT_TREE
    p.normal = vec3_splat(0.0f);
#endif
    p.throughput = colour_splat(1.0f);
#if TRIAD_TRANSMISSION
    p.body_scale = 1.0f;
    p.bodies = bodies_none();
    p.from = VEC3_OF(ray.origin);
#endif
    p.radiance = colour_splat(0.0f);
    p.alpha = 1.0f;
    p.colours = colours;
#if PATH_FORKS
    p.fork.branch = p.fork.edge = 0u;
#endif
    return p;
}

TRIAD_FUNCTION Vec3 path_direction(const PathState* path) { return VEC3_OF(path->ray.direction); }

/* Where the path is, at `position`, as lights see it. */
TRIAD_FUNCTION Receiver path_receiver(const PathState* path, Vec3 position) {
    Receiver receiver = {position, vec3_splat(0.0f), path->traits >> PATH_FACING_SHIFT};
#if TRIAD_LIGHT_TREE
    receiver.normal = path->normal;
#if TRIAD_ENVIRONMENT_MAP
    receiver.facing = facing_of(path->normal);
#endif
#endif
    return receiver;
}

TRIAD_FUNCTION float path_body_scale(const PathState* path) {
#if TRIAD_TRANSMISSION
    return path->body_scale;
#else
    (void)path;
    return 1.0f;
#endif
}

/* Whether the path is about to look at the surface where it forked once more. */
TRIAD_FUNCTION int path_is_back(const PathState* path) {
#if PATH_FORKS
    return path->fork.branch != 0u && path->edge == path->fork.edge;
#else
    (void)path;
    return 0;
#endif
}

/* Every wavelength but the first has numbers of its own, from the surface after the fork on: at the fork
 * itself it goes on with those of the wavelength before. */
TRIAD_FUNCTION Sampler path_sampler(const PathState* path) {
    Sampler s = path->sampler;
#if PATH_FORKS
    const uint branch = path->fork.branch - (uint)path_is_back(path);
    if (branch != 0u) s.key0 = random_mix(s.key0 + branch);
#endif
    return s;
}

/* Of the vertex at the end of the edge. */
TRIAD_FUNCTION SamplerBlock path_numbers(const PathState* path) {
    const Sampler s = path_sampler(path);
    return sampler_block(&s, path->edge);
}

/* Of the ray of the edge, by which the alpha test decides; the shadow ray from its end has the next. */
TRIAD_FUNCTION uint path_ray_name(const PathState* path) {
#if TRIAD_ALPHA_TEST
    const Sampler s = path_sampler(path);
    return coverage_ray(&s, path->edge);
#else
    (void)path;
    return 0u;
#endif
}

#endif
