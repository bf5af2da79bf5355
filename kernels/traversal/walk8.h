/* The walk over nodes of eight boxes, which are tested all at once: part of traverse.h. */
#ifndef TRIAD_TRAVERSAL_WALK8_H
#define TRIAD_TRAVERSAL_WALK8_H
#include "traversal/scene.h"
#if !TRIAD_BVH4

/* Tests the block of a leaf; with `any` returns 1 at the first hit, else updates `best` and returns 0. */
TRIAD_FUNCTION int traversal_visit_leaf(const Traversal* scene, uint leaf, const SpaceRay* ray, Hit* best,
                                        const int any) {
    global const TriangleBlock* block = scene->blocks + (leaf & BVH_INDEX);
    TRAVERSAL_COUNT(scene, blocks, 1u);
    TRAVERSAL_COUNT(scene, triangles, 4u);
    TriangleHits hits;
    const int4 lanes = triangle_intersect(block, 0u, &ray->sheared, best->t, ray->skip, &hits);
    const int2 pairs = lanes.lo | lanes.hi;
    if ((pairs.x | pairs.y) == 0) return 0;
#if !TRAVERSAL_TESTS_ALPHA
    if (any) return 1;
#endif
    /* Selects: as_uint(convert_char4(lanes)) kills Intel's compiler for GPUs (IGC 1.0.12504). */
    uint mask = (lanes.s0 ? 0xffu : 0u) | (lanes.s1 ? 0xff00u : 0u) | (lanes.s2 ? 0xff0000u : 0u) |
                (lanes.s3 ? 0xff000000u : 0u);
    float t[4], u[4], v[4];
    vstore4(hits.t, 0, t);
    vstore4(hits.u, 0, u);
    vstore4(hits.v, 0, v);
    do {
        const uint lane = (31u - clz(mask & (0u - mask))) >> 3;
        mask &= ~(0xffu << (lane * 8u));
        if (traversal_take(scene, leaf, lane, t[lane], u[lane], v[lane], ray->instance, best, any)) return 1;
    } while (mask != 0u);
    return 0;
}

/* Asks for what a child that goes to the stack will be read from: scenes beyond the cache walk up to a tenth
 * faster. */
TRIAD_FUNCTION void traversal_prefetch(const Traversal* scene, uint child) {
    if (child & BVH_LEAF) {
        global const char* block = (global const char*)(scene->blocks + (child & BVH_INDEX));
        TRIAD_PREFETCH(block);
        TRIAD_PREFETCH(block + 64);
        TRIAD_PREFETCH(block + 128);
    } else if (!(child & BVH_INSTANCE)) {
        global const char* node = (global const char*)(scene->nodes + child);
        TRIAD_PREFETCH(node);
        TRIAD_PREFETCH(node + 64);
        TRIAD_PREFETCH(node + 128);
        TRIAD_PREFETCH(node + 192);
    }
}

/* A child and where the ray enters it, which is not negative: packs compare as their entries. */
TRIAD_FUNCTION ulong traversal_pack(uint child, float entry) { return (ulong)as_uint(entry) << 32 | child; }

/* Which of the children in `mask`, of which there is one, is walked next; the others go to the stack. Nearer
 * ones come first; with `any` as the node has them. */
TRIAD_FUNCTION_PER_CALL uint traversal_choose(const Traversal* scene, global const Bvh8Node* node, ulong mask,
                                              float8 entries, ulong* stack, uint* size, const int any) {
    const uint first = slab_next(&mask);
    if (mask == 0ul) return node->child[first];
    float entry[8];
    vstore8(entries, 0, entry);
    ulong nearest = traversal_pack(node->child[first], any ? 0.0f : entry[first]);
    const uint floor_of_node = *size;
    do {
        const uint next = slab_next(&mask);
        const ulong other = traversal_pack(node->child[next], any ? 0.0f : entry[next]);
        const ulong farther = any ? other : max(nearest, other);
        nearest = any ? nearest : min(nearest, other);
        uint place = (*size)++;
        if (!any)
            for (; place > floor_of_node && stack[place - 1u] < farther; --place)
                stack[place] = stack[place - 1u];
        stack[place] = farther;
        traversal_prefetch(scene, (uint)other);
    } while (mask != 0ul);
    TRAVERSAL_WAITING(scene, *size);
    return (uint)nearest;
}

/* The walk. `any` is a constant of the call: 1 stops at the first hit and returns 1, 0 leaves the closest in
 * `best`. */
TRIAD_FUNCTION_PER_CALL int traversal_walk(const Traversal* scene, const Ray* ray, Hit* best, const int any) {
    ulong stack[(1 + TRIAD_INSTANCES) * BVH8_STACK];
    uint size = 0u;
    uint child = scene->root;
    SpaceRay space = traversal_space(scene, ray, 0u);
#if TRIAD_INSTANCES
    uint floor_of_instance = 0u; /* stack size at which the current instance is done */
#endif
    for (;;) {
        if (child & BVH_LEAF) {
            if (traversal_visit_leaf(scene, child, &space, best, any)) return 1;
#if TRIAD_INSTANCES
        } else if (child & BVH_INSTANCE) {
            space = traversal_space(scene, ray, child & BVH_INDEX);
            floor_of_instance = size;
            child = scene->instances[space.instance].root[0];
            continue;
#endif
        } else {
            TRAVERSAL_COUNT(scene, nodes, 1u);
            global const Bvh8Node* node = scene->nodes + child;
            float8 entries;
            const ulong mask = slab_intersect(node, &space.slab, &space.slab, best->t, &entries);
            if (mask != 0ul) {
                child = traversal_choose(scene, node, mask, entries, stack, &size, any);
                continue;
            }
        }
        do { /* the next child that starts before the best hit */
#if TRIAD_INSTANCES
            if (size == floor_of_instance && space.instance != 0u) {
                floor_of_instance = 0u;
                space = traversal_space(scene, ray, 0u);
            }
#endif
            if (size == 0u) return 0;
            child = (uint)stack[--size];
        } while (!any && as_float((uint)(stack[size] >> 32)) > best->t);
    }
}

#endif
#endif
