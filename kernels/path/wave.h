/* The driver `wave`: a pool of paths, which all do one stage before any does the next, so that they can be
 * lanes, and so that each stage has few registers to keep. A path has a slot of the pool, which follows the
 * samples of one pixel after the other, so that a pixel's sums have one owner; pixels without a slot wait in
 * the launch's list of work.
 *
 * One round takes every path one edge further (path/wave_stages.h):
 *   wave_end      miss; the next wavelength; or add, and the slot's next sample
 *   wave_start    start
 *   wave_edge     what the edge meets
 *   wave_vertex   surface, emission, fork, gather, connect, scatter and survive; in launches wave_meet,
 *                 wave_films, wave_gather, wave_connect and wave_scatter
 *   wave_shadow   the light that the vertex has chosen, if it is seen
 * Where the stages are loops over the slots of a work-item's own pool, one launch does it all (path/wave.cl);
 * where they are launches, every work-item has a slot (path/wave_stages.cl).
 * Between stages a path lies in planes of 32-bit words, one for each member: slot i has word i. */
#ifndef TRIAD_PATH_WAVE_H
#define TRIAD_PATH_WAVE_H

#include "path/connect.h"
#include "path/start.h"

/* Where a slot's path stands. */
#define WAVE_NEW 0u   /* the slot has no pixel yet */
#define WAVE_START 1u /* a sample is to be started */
#define WAVE_EDGE 2u  /* an edge is to be traced */
#define WAVE_HIT 3u   /* it has met a surface */
#define WAVE_MISS 4u  /* it has met none */
#define WAVE_END 5u   /* the path has ended */
#define WAVE_IDLE 6u  /* there are no more pixels */
#define WAVE_GO 7u    /* it is to go on from the surface it has met */
/* Added where a light waits for its shadow ray. */
#define WAVE_LIGHT 8u
/* Added to WAVE_END after the longest path that is allowed. */
#define WAVE_LONGEST 16u

/* Planes of the pool, from its first slot on. */
typedef struct Pool {
    global uint* states;  /* WAVE_* */
    global uint* pixels;  /* of a slot, counted over the tiles of the launch */
    global uint* taken;   /* samples that this pixel has had */
    global uint* rays;    /* traced and not yet counted, where stages are launches */
    global uint* paths;   /* PathState */
    global uint* hits;    /* Hit */
    global uint* pending; /* PendingLight */
    global float* films;  /* POOL_FILM_WORDS of each slot, where stages are launches */
} Pool;

TRIAD_FUNCTION_PER_CALL Pool pool_at(size_t pool, global uint* states, global uint* pixels,
                                     global uint* taken, global uint* rays, global uint* paths,
                                     global uint* hits, global uint* pending, global float* films) {
    const size_t first = pool * POOL_PLANE;
    const Pool p = {states + first,
                    pixels + first,
                    taken + first,
                    rays + first,
                    paths + first * POOL_PATH_PLANES,
                    hits + first * POOL_HIT_PLANES,
                    pending + first * POOL_LIGHT_PLANES,
                    films + pool * POOL_SLOTS * POOL_FILM_WORDS};
    return p;
}

/* Parts of a path: stages store those that they change. */
#define PART_NAME 1u     /* sampler */
#define PART_EDGE 2u     /* ray, edge, pdf, body_scale */
#define PART_LOAD 4u     /* throughput, bodies */
#define PART_FROM 8u     /* from, normal */
#define PART_COLOURS 16u /* colours */
#define PART_FOUND 32u   /* radiance, alpha */
#define PART_FORK 64u    /* branch and edge of fork */
#define PART_FORKED 128u /* the rest of it: set where the path forks */
#define PART_TRAITS 256u
#define PART_ALL 511u

/* Words of a slot on their way between planes and a path's members, in the order of the calls. */
typedef struct Planes {
    global uint* words;
    size_t next; /* word */
    uint parts;  /* that are moved */
    int moves;   /* the present one is */
    int stores;  /* from members to planes, or back */
} Planes;

TRIAD_FUNCTION_PER_CALL Planes planes_load(global const uint* words, size_t i, uint parts) {
    const Planes p = {(global uint*)words, i, parts, 1, 0};
    return p;
}
TRIAD_FUNCTION_PER_CALL Planes planes_store(global uint* words, size_t i, uint parts) {
    const Planes p = {words, i, parts, 1, 1};
    return p;
}
TRIAD_FUNCTION_PER_CALL void planes_part(Planes* p, uint part) { p->moves = (p->parts & part) != 0u; }
TRIAD_FUNCTION_PER_CALL void planes_uint(Planes* p, uint* member) {
    if (p->moves) {
        if (p->stores)
            p->words[p->next] = *member;
        else
            *member = p->words[p->next];
    }
    p->next += POOL_PLANE;
}
TRIAD_FUNCTION_PER_CALL void planes_float(Planes* p, float* member) {
    if (p->moves) {
        if (p->stores)
            p->words[p->next] = as_uint(*member);
        else
            *member = as_float(p->words[p->next]);
    }
    p->next += POOL_PLANE;
}
TRIAD_FUNCTION_PER_CALL void planes_vec3(Planes* p, Vec3* v) {
    planes_float(p, &v->x), planes_float(p, &v->y), planes_float(p, &v->z);
}
TRIAD_FUNCTION_PER_CALL void planes_array3(Planes* p, float v[3]) {
    planes_float(p, v), planes_float(p, v + 1), planes_float(p, v + 2);
}
TRIAD_FUNCTION_PER_CALL void planes_colour(Planes* p, Colour* c) {
    planes_float(p, &c->x), planes_float(p, &c->y), planes_float(p, &c->z);
#if TRIAD_HERO
    planes_float(p, &c->w);
#endif
}
TRIAD_FUNCTION_PER_CALL void planes_ray(Planes* p, Ray* ray) {
    planes_array3(p, ray->origin), planes_array3(p, ray->direction);
    planes_float(p, &ray->t_max);
    planes_uint(p, &ray->skip_instance), planes_uint(p, &ray->skip_primitive);
}
TRIAD_FUNCTION_PER_CALL void planes_hit(Planes* p, Hit* hit) {
    planes_float(p, &hit->t), planes_float(p, &hit->u), planes_float(p, &hit->v);
    planes_uint(p, &hit->primitive), planes_uint(p, &hit->instance), planes_uint(p, &hit->block);
}
#if TRIAD_TRANSMISSION
TRIAD_FUNCTION_PER_CALL void planes_bodies(Planes* p, Bodies* b) {
    planes_uint(p, &b->x), planes_uint(p, &b->y), planes_uint(p, &b->z), planes_uint(p, &b->w);
}
#endif
TRIAD_FUNCTION_PER_CALL void planes_path_colour(Planes* p, PathColour* c) {
#if TRIAD_HERO
    planes_colour(p, &c->wavelengths), planes_colour(p, &c->share);
    for (uint k = 0u; k < 3u; ++k) planes_colour(p, &c->basis[k]), planes_colour(p, &c->filter[k]);
#else
    planes_float(p, &c->wavelength);
#if TRIAD_DISPERSION
    planes_vec3(p, &c->filter), planes_vec3(p, &c->before);
    planes_float(p, &c->share);
#endif
#endif
}

/* Every member of PathState. */
TRIAD_FUNCTION_PER_CALL void planes_path(Planes* p, PathState* path) {
    planes_part(p, PART_NAME);
    planes_uint(p, &path->sampler.index_reversed);
    planes_uint(p, &path->sampler.key0), planes_uint(p, &path->sampler.key1);
    planes_uint(p, &path->sampler.first_block);
    planes_part(p, PART_EDGE);
    planes_ray(p, &path->ray);
    planes_uint(p, &path->edge);
    planes_part(p, PART_TRAITS);
    planes_uint(p, &path->traits);
    planes_part(p, PART_EDGE);
    planes_float(p, &path->pdf);
#if TRIAD_TRANSMISSION
    planes_float(p, &path->body_scale);
#endif
    planes_part(p, PART_LOAD);
    planes_colour(p, &path->throughput);
#if TRIAD_TRANSMISSION
    planes_bodies(p, &path->bodies);
#endif
    planes_part(p, PART_FROM);
#if TRIAD_TRANSMISSION
    planes_vec3(p, &path->from);
#endif
#if TRIAD_LIGHT_TREE
    planes_vec3(p, &path->normal);
#endif
    planes_part(p, PART_COLOURS);
    planes_path_colour(p, &path->colours);
    planes_part(p, PART_FOUND);
    planes_colour(p, &path->radiance);
    planes_float(p, &path->alpha);
#if PATH_FORKS
    planes_part(p, PART_FORK);
    PathFork* fork = &path->fork;
    planes_uint(p, &fork->branch), planes_uint(p, &fork->edge);
    planes_part(p, PART_FORKED);
    planes_hit(p, &fork->hit);
    planes_array3(p, fork->direction);
    planes_uint(p, &fork->traits);
    planes_colour(p, &fork->throughput);
    planes_float(p, &fork->pdf), planes_float(p, &fork->body_scale);
    planes_bodies(p, &fork->bodies);
#endif
}

TRIAD_FUNCTION_PER_CALL void planes_light(Planes* p, PendingLight* light) {
    planes_ray(p, &light->ray);
    planes_colour(p, &light->worth);
#if TRIAD_ALPHA_TEST
    planes_uint(p, &light->name);
#endif
#if TRIAD_ENVIRONMENT_MAP
    planes_float(p, &light->inverse_pdf), planes_float(p, &light->bsdf_pdf);
    planes_float(p, &light->uv.x), planes_float(p, &light->uv.y);
    planes_uint(p, &light->flags);
#endif
}

#define POOL_MOVE(kind, moved, member)       \
    do {                                     \
        Planes pool_planes = moved;          \
        planes_##kind(&pool_planes, member); \
    } while (0)
#define POOL_LOAD_PARTS(kind, planes, member, parts) POOL_MOVE(kind, planes_load(planes, i, parts), member)
#define POOL_STORE_PARTS(kind, planes, member, parts) POOL_MOVE(kind, planes_store(planes, i, parts), member)
#define POOL_LOAD(kind, planes, member) POOL_LOAD_PARTS(kind, planes, member, PART_ALL)
#define POOL_STORE(kind, planes, member) POOL_STORE_PARTS(kind, planes, member, PART_ALL)

#endif
