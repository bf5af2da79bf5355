/* What rays are traced against, a ray in a tree's space, and which hit is kept: what both walks share. */
#ifndef TRIAD_TRAVERSAL_SCENE_H
#define TRIAD_TRAVERSAL_SCENE_H
#include "traversal/slab.h"
#include "traversal/triangle.h"

/* A program that counts what walks do defines TRIAD_COUNT_WORK 1 (path/count.cl). */
#ifndef TRIAD_COUNT_WORK
#define TRIAD_COUNT_WORK 0
#endif

#if TRIAD_COUNT_WORK
#define TRAVERSAL_COUNT(scene, what, n) ((scene)->work->what += (n))
#define TRAVERSAL_WAITING(scene, size) ((scene)->work->deepest = max((scene)->work->deepest, (size)))
#else
#define TRAVERSAL_COUNT(scene, what, n)
#define TRAVERSAL_WAITING(scene, size)
#endif

#define TRAVERSAL_TESTS_ALPHA 0
#ifdef TRAVERSAL_ACCEPT
#undef TRAVERSAL_TESTS_ALPHA
#define TRAVERSAL_TESTS_ALPHA TRIAD_ALPHA_TEST
#endif

/* What rays are traced against. Pass it by pointer: it dissolves when inlined. */
typedef struct Traversal {
    global const BvhNode* nodes;
    global const TriangleBlock* blocks;
    global const Instance* instances; /* read only where a leaf has BVH_INSTANCE */
    uint root;
#ifdef TRAVERSAL_CONTEXT
    TRAVERSAL_CONTEXT context;
#endif
#if TRIAD_COUNT_WORK
    RayWork* work; /* of one ray: the caller's to set */
#endif
} Traversal;

/* root: node of the tree that rays begin in. The context, where there is one, is the caller's to set. */
TRIAD_FUNCTION Traversal traversal_make(global const BvhNode* nodes, global const TriangleBlock* blocks,
                                        global const Instance* instances, uint root) {
    Traversal t;
    t.nodes = nodes;
    t.blocks = blocks;
    t.instances = instances;
    t.root = root;
    return t;
}

/* A ray in the space of the tree that it walks, and the triangle there that it must not hit. */
typedef struct SpaceRay {
    SlabRay slab;
    TriangleRay sheared;
    uint instance;
    uint skip;
} SpaceRay;

/* instance: 0 for the world. */
TRIAD_FUNCTION SpaceRay traversal_space(const Traversal* scene, const Ray* ray, uint instance) {
    float origin[3] = {ray->origin[0], ray->origin[1], ray->origin[2]};
    float direction[3] = {ray->direction[0], ray->direction[1], ray->direction[2]};
#if TRIAD_INSTANCES
    if (instance != 0u) {
        global const float* m = scene->instances[instance].to_object;
#pragma unroll
        for (int row = 0; row < 3; ++row, m += 4) {
            origin[row] =
                fma(m[0], ray->origin[0], fma(m[1], ray->origin[1], fma(m[2], ray->origin[2], m[3])));
            direction[row] =
                fma(m[0], ray->direction[0], fma(m[1], ray->direction[1], m[2] * ray->direction[2]));
        }
    }
#endif
    SpaceRay space;
    space.slab = slab_ray(origin, direction);
    space.sheared = triangle_ray(origin, direction);
    space.instance = instance;
    space.skip = ray->skip_instance == instance ? ray->skip_primitive : TRIAD_NONE;
    return space;
}

/* A candidate of a block against the best hit so far: nearer, or as near and of lower (instance, primitive).
 */
TRIAD_FUNCTION int traversal_is_better(const Hit* best, float t, uint instance, uint primitive) {
    return t < best->t || (t == best->t && (instance < best->instance ||
                                            (instance == best->instance && primitive < best->primitive)));
}

/* What a block's lane that is hit is worth. With `any` returns 1 when the ray stops there, else updates
 * `best` and returns 0. */
TRIAD_FUNCTION int traversal_take(const Traversal* scene, uint leaf, uint lane, float t, float u, float v,
                                  uint instance, Hit* best, const int any) {
    const uint primitive = scene->blocks[leaf & BVH_INDEX].primitive[lane];
    if (!any && !traversal_is_better(best, t, instance, primitive)) return 0;
#if TRAVERSAL_TESTS_ALPHA
    if ((leaf & BVH_ALPHA) && !TRAVERSAL_ACCEPT(scene->context, instance, primitive, u, v)) return 0;
#endif
    if (any) return 1;
    best->t = t;
    best->u = u;
    best->v = v;
    best->primitive = primitive;
    best->instance = instance;
    best->block = (leaf & BVH_INDEX) * 4u + lane;
    return 0;
}

#endif
