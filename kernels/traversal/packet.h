/* Rays that nearly coincide, such as those of the camera through a pixel or through neighbours: one walk for
 * all of them, over nodes of eight boxes. A box is met that any of them may meet, by bounds on their origins
 * and directions; triangles are then tested against every ray at once. The hits are those of
 * traverse_closest(), bit for bit: boxes decide nothing, and the test of triangles is one text (edges.h).
 * Any rays may be walked so, but those that have little in common visit much for each other, and one that is
 * no ray (NaN, no direction) may take the hits of the others.
 * After Wald, Slusallek, Benthin, Wagner, "Interactive rendering with coherent ray tracing" (2001), and
 * Boulos et al., "Packet-based Whitted and distribution ray tracing" (2007), whose bounds are by intervals
 * too. */
#ifndef TRIAD_TRAVERSAL_PACKET_H
#define TRIAD_TRAVERSAL_PACKET_H
#include "traversal/packet_space.h"
#include "traversal/traverse.h"
#if TRIAD_PACKETS

TRIANGLE_DIFFERENCE_OF_PRODUCTS(packet_difference_of_products, PacketFloat)

/* Which triangles of a block some ray may hit, as the top bits of bytes: not those that lie to one side of
 * all rays, which go out from one point and share their axes. Sheared coordinates rise or fall with the
 * shear, rounded or not, so that the two ends bound what edges.h sees; it hits nothing whose corners all have
 * an x, or a y, of one sign (products below 2^-126, which are 0, aside). */
TRIAD_FUNCTION uint packet_candidates(const PacketSpace* space, global const TriangleBlock* block) {
    if (!space->culls) return 0x80808080u;
    global const float* corner = &block->vertex[0][0];
    float4 x_least = (float4)(INFINITY), y_least = x_least, x_most = -x_least, y_most = -x_least;
#pragma unroll
    for (int i = 0; i < 3; ++i, corner += 12) {
        const float4 z = vload4(0, corner + space->row_z) - space->origin_z.s0;
        const float4 x = vload4(0, corner + space->row_x) - space->origin_x.s0;
        const float4 y = vload4(0, corner + space->row_y) - space->origin_y.s0;
        const float4 x0 = fma((float4)(space->shears_x[0]), z, x),
                     x1 = fma((float4)(space->shears_x[1]), z, x);
        const float4 y0 = fma((float4)(space->shears_y[0]), z, y),
                     y1 = fma((float4)(space->shears_y[1]), z, y);
        const float4 x_low = x0 < x1 ? x0 : x1, x_high = x0 < x1 ? x1 : x0;
        const float4 y_low = y0 < y1 ? y0 : y1, y_high = y0 < y1 ? y1 : y0;
        x_least = x_low < x_least ? x_low : x_least;
        x_most = x_high > x_most ? x_high : x_most;
        y_least = y_low < y_least ? y_low : y_least;
        y_most = y_high > y_most ? y_high : y_most;
    }
    const int4 may = (x_least <= 0.0f) & (x_most >= 0.0f) & (y_least <= 0.0f) & (y_most >= 0.0f);
    /* Selects: as of traversal_visit_leaf(). */
    return (may.s0 ? 0x80u : 0u) | (may.s1 ? 0x8000u : 0u) | (may.s2 ? 0x800000u : 0u) |
           (may.s3 ? 0x80000000u : 0u);
}

/* A corner of a triangle as every ray sees it. */
TRIAD_FUNCTION void packet_corner(const PacketSpace* space, global const float* corner, PacketFloat* x,
                                  PacketFloat* y, PacketFloat* z) {
    if (space->share_axes) {
        *x = (PacketFloat)(corner[space->row_x]);
        *y = (PacketFloat)(corner[space->row_y]);
        *z = (PacketFloat)(corner[space->row_z]);
    } else {
        packet_permute(space, (PacketFloat)(corner[0]), (PacketFloat)(corner[4]), (PacketFloat)(corner[8]), x,
                       y, z);
    }
    *z -= space->origin_z;
    *x = fma(space->shear_x, *z, *x - space->origin_x);
    *y = fma(space->shear_y, *z, *y - space->origin_y);
}

typedef struct PacketHits {
    PacketFloat t, u, v;
} PacketHits;

#define PACKET_STOP(lanes) \
    if (packet_lanes(lanes) == 0ul) return 0

/* Which rays hit the triangle in lane `lane` of the block with 0 < t; t, u, v in `hits`. */
TRIAD_FUNCTION PacketMask packet_meet(const PacketSpace* space, global const TriangleBlock* block, uint lane,
                                      PacketHits* hits) {
    global const float* corner = &block->vertex[0][0] + lane;
    PacketFloat ax, ay, az, bx, by, bz, cx, cy, cz;
    packet_corner(space, corner, &ax, &ay, &az);
    packet_corner(space, corner + 12, &bx, &by, &bz);
    packet_corner(space, corner + 24, &cx, &cy, &cz);
    const PacketFloat shear_z = space->shear_z;
    TRIANGLE_EDGES(PacketFloat, PacketMask, packet_difference_of_products, PACKET_STOP);
    return lanes & (t > 0.0f);
}

/* The best hits so far, as lanes. */
typedef struct PacketBest {
    PacketFloat t, u, v;
    PacketUint primitive, instance, block;
} PacketBest;

#if TRAVERSAL_TESTS_ALPHA
/* Of the rays in `taken` those that do not pass through. Traversal.context points to one for every ray. */
TRIAD_FUNCTION PacketMask packet_accepted(const Traversal* scene, uint instance, uint primitive,
                                          const PacketHits* hits, PacketMask taken) {
    float u[PACKET_RAYS], v[PACKET_RAYS];
    int accepted[PACKET_RAYS];
    vstore8(hits->u, 0, u), vstore8(hits->v, 0, v), vstore8(taken, 0, accepted);
    for (int i = 0; i < PACKET_RAYS; ++i)
        if (accepted[i])
            accepted[i] = -(TRAVERSAL_ACCEPT(scene->context + i, instance, primitive, u[i], v[i]) != 0);
    return vload8(0, accepted);
}
#endif

/* Tests the block of a leaf and updates `best`. 0: it holds what it held. */
TRIAD_FUNCTION int packet_visit_leaf(const Traversal* scene, uint leaf, const PacketSpace* space,
                                     PacketBest* best) {
    global const TriangleBlock* block = scene->blocks + (leaf & BVH_INDEX);
    int is_better = 0;
    for (uint candidates = packet_candidates(space, block); candidates != 0u; candidates &= candidates - 1u) {
        const uint lane = (31u - clz(candidates & (0u - candidates))) >> 3;
        PacketHits hits;
        PacketMask taken = packet_meet(space, block, lane, &hits);
        if (packet_lanes(taken) == 0ul) continue;
        /* traversal_is_better() */
        const uint primitive = block->primitive[lane];
        const PacketMask first = (space->instance < best->instance) |
                                 ((space->instance == best->instance) & (primitive < best->primitive));
        taken &= (hits.t < best->t) | ((hits.t == best->t) & first);
#if TRAVERSAL_TESTS_ALPHA
        if ((leaf & BVH_ALPHA) && packet_lanes(taken) != 0ul)
            taken = packet_accepted(scene, space->instance, primitive, &hits, taken);
#endif
        if (packet_lanes(taken) == 0ul) continue;
        best->t = taken ? hits.t : best->t;
        best->u = taken ? hits.u : best->u;
        best->v = taken ? hits.v : best->v;
        best->primitive = taken ? (PacketUint)(primitive) : best->primitive;
        best->instance = taken ? (PacketUint)(space->instance) : best->instance;
        best->block = taken ? (PacketUint)((leaf & BVH_INDEX) * 4u + lane) : best->block;
        is_better = 1;
    }
    return is_better;
}

TRIAD_FUNCTION void packet_walk(const Traversal* scene, const Packet* rays, PacketBest* best) {
    ulong stack[(1 + TRIAD_INSTANCES) * BVH8_STACK];
    uint size = 0u;
    uint child = scene->root;
    float t_max = packet_greatest(best->t);
    PacketSpace space = packet_space(scene, rays, 0u);
#if TRIAD_INSTANCES
    uint floor_of_instance = 0u; /* stack size at which the current instance is done */
#endif
    for (;;) {
        if (child & BVH_LEAF) {
            if (packet_visit_leaf(scene, child, &space, best)) t_max = packet_greatest(best->t);
#if TRIAD_INSTANCES
        } else if (child & BVH_INSTANCE) {
            space = packet_space(scene, rays, child & BVH_INDEX);
            floor_of_instance = size;
            child = scene->instances[space.instance].root[0];
            continue;
#endif
        } else {
            global const Bvh8Node* node = scene->nodes + child;
            float8 entries;
            const ulong mask = slab_intersect(node, &space.enters, &space.leaves, t_max, &entries);
            if (mask != 0ul) {
                child = traversal_choose(scene, node, mask, entries, stack, &size, 0);
                continue;
            }
        }
        do { /* the next child that starts before the farthest of the best hits */
#if TRIAD_INSTANCES
            if (size == floor_of_instance && space.instance != 0u) {
                floor_of_instance = 0u;
                space = packet_space(scene, rays, 0u);
            }
#endif
            if (size == 0u) return;
            child = (uint)stack[--size];
        } while (as_float((uint)(stack[size] >> 32)) > t_max);
    }
}

/* hits[i] = traverse_closest() of rays[i]. */
TRIAD_FUNCTION_ONCE void traverse_packet(const Traversal* scene, const PacketRays* rays,
                                         Hit hits[PACKET_RAYS]) {
    Packet lanes;
    PacketMask apart = (PacketMask)(0);
#pragma unroll
    for (int axis = 0; axis < 3; ++axis) {
        lanes.origin[axis] = vload8(0, rays->origin[axis]);
        lanes.direction[axis] = vload8(0, rays->direction[axis]);
        apart |= lanes.origin[axis] != lanes.origin[axis].s0;
    }
    lanes.from_one_point = packet_lanes(apart) == 0ul;
    PacketBest best;
    best.t = vload8(0, rays->t_max);
    best.u = best.v = (PacketFloat)(0.0f);
    best.primitive = best.instance = (PacketUint)(TRIAD_NONE);
    best.block = (PacketUint)(0u);
    packet_walk(scene, &lanes, &best);

    float t[PACKET_RAYS], u[PACKET_RAYS], v[PACKET_RAYS];
    uint primitive[PACKET_RAYS], instance[PACKET_RAYS], block[PACKET_RAYS];
    vstore8(best.t, 0, t), vstore8(best.u, 0, u), vstore8(best.v, 0, v);
    vstore8(best.primitive, 0, primitive), vstore8(best.instance, 0, instance), vstore8(best.block, 0, block);
    for (int i = 0; i < PACKET_RAYS; ++i) {
        const Hit hit = {t[i], u[i], v[i], primitive[i], instance[i], block[i], {0u, 0u}};
        hits[i] = hit;
    }
}

#endif
#endif
