/* The walk over nodes of four boxes, one at a time: part of traverse.h. */
#ifndef TRIAD_TRAVERSAL_WALK4_H
#define TRIAD_TRAVERSAL_WALK4_H
#include "traversal/scene.h"
#if TRIAD_BVH4

/* Tests the triangles of a leaf; with `any` returns 1 at the first hit, else updates `best` and returns 0. */
TRIAD_FUNCTION int traversal_visit_leaf(const Traversal* scene, uint leaf, const SpaceRay* ray, Hit* best,
                                        const int any) {
    global const TriangleBlock* block = scene->blocks + (leaf & BVH_INDEX);
    TRAVERSAL_COUNT(scene, blocks, 1u);
    uint before = TRIAD_NONE;
#pragma unroll 1 /* four copies take four times the registers */
    for (uint lane = 0u; lane < 4u && block->primitive[lane] != before; ++lane) {
        before = block->primitive[lane];
        TRAVERSAL_COUNT(scene, triangles, 1u);
        TriangleHits hit;
        if (!triangle_intersect(block, lane, &ray->sheared, best->t, ray->skip, &hit)) continue;
        if (traversal_take(scene, leaf, lane, hit.t, hit.u, hit.v, ray->instance, best, any)) return 1;
    }
    return 0;
}

/* Puts the nearer of two children first. */
TRIAD_FUNCTION void traversal_order(float entry[4], uint child[4], int a, int b) {
    if (entry[b] < entry[a]) {
        const float farther = entry[a];
        const uint other = child[a];
        entry[a] = entry[b];
        child[a] = child[b];
        entry[b] = farther;
        child[b] = other;
    }
}

/* Which child of a node is walked next, TRIAD_NONE: none; the others that the ray meets go to the stack.
 * Nearer ones come first; with `any` those of larger boxes, as the node has them. */
TRIAD_FUNCTION uint traversal_choose(float entry[4], uint child[4], uint* stack, uint* size, const int any) {
    if (!any) {
        traversal_order(entry, child, 0, 1);
        traversal_order(entry, child, 2, 3);
        traversal_order(entry, child, 0, 2);
        traversal_order(entry, child, 1, 3);
        traversal_order(entry, child, 1, 2);
    }
    uint next = TRIAD_NONE;
#pragma unroll
    for (int c = 3; c >= 0; --c)
        if (entry[c] < INFINITY) {
            if (next != TRIAD_NONE) stack[(*size)++] = next;
            next = child[c];
        }
    return next;
}

/* The walk. `any` is a constant of the call: 1 stops at the first hit and returns 1, 0 leaves the closest in
 * `best`. */
TRIAD_FUNCTION_PER_CALL int traversal_walk(const Traversal* scene, const Ray* ray, Hit* best, const int any) {
    uint stack[(1 + TRIAD_INSTANCES) * BVH4_STACK];
    uint size = 0u;
    uint child = scene->root;
    SpaceRay space = traversal_space(scene, ray, 0u);
#if TRIAD_INSTANCES
    uint instance = 0u;          /* whose tree is walked next */
    uint floor_of_instance = 0u; /* stack size at which it is done */
#endif
    for (;;) {
#if TRIAD_INSTANCES
        /* The only place: copies of it would take registers. */
        if (space.instance != instance) space = traversal_space(scene, ray, instance);
#endif
        if (child & BVH_LEAF) {
            if (traversal_visit_leaf(scene, child, &space, best, any)) return 1;
#if TRIAD_INSTANCES
        } else if (child & BVH_INSTANCE) {
            instance = child & BVH_INDEX;
            floor_of_instance = size;
            child = scene->instances[instance].root[1];
            continue;
#endif
        } else {
            TRAVERSAL_COUNT(scene, nodes, 1u);
            float entry[4];
            uint children[4];
            slab_intersect(scene->nodes + child, &space.slab, best->t, entry, children);
            const uint next = traversal_choose(entry, children, stack, &size, any);
            TRAVERSAL_WAITING(scene, size);
            if (next != TRIAD_NONE) {
                child = next;
                continue;
            }
        }
#if TRIAD_INSTANCES
        if (size == floor_of_instance && instance != 0u) instance = floor_of_instance = 0u;
#endif
        if (size == 0u) return 0;
        child = stack[--size];
    }
}

#endif
#endif
