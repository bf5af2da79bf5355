/* The rays of a packet as lanes, and in a tree's space: part of packet.h. */
#ifndef TRIAD_TRAVERSAL_PACKET_SPACE_H
#define TRIAD_TRAVERSAL_PACKET_SPACE_H
#include "traversal/scene.h"
#if TRIAD_PACKETS

typedef float8 PacketFloat;
typedef int8 PacketMask;
typedef uint8 PacketUint;

/* One bit of it in each byte that is a lane; 0: no lane is true. */
TRIAD_FUNCTION ulong packet_lanes(PacketMask mask) {
    return as_ulong(convert_char8(mask)) & 0x8080808080808080ul;
}

/* A value of every ray, axis by axis; no ray skips a triangle. */
typedef struct PacketRays {
    float origin[3][PACKET_RAYS];
    float direction[3][PACKET_RAYS];
    float t_max[PACKET_RAYS];
} PacketRays;

TRIAD_FUNCTION void packet_set(PacketRays* rays, uint i, Ray ray) {
    for (int axis = 0; axis < 3; ++axis) {
        rays->origin[axis][i] = ray.origin[axis];
        rays->direction[axis][i] = ray.direction[axis];
    }
    rays->t_max[i] = ray.t_max;
}

/* The rays as lanes. */
typedef struct Packet {
    PacketFloat origin[3], direction[3];
    int from_one_point;
} Packet;

/* The rays in the space of a tree, as slabs and triangles need them. */
typedef struct PacketSpace {
    SlabRay enters, leaves; /* slab_intersect() */
    PacketFloat origin_x, origin_y, origin_z, shear_x, shear_y,
        shear_z;                    /* as of TriangleRay; shears negated */
    float shears_x[2], shears_y[2]; /* the least and the greatest */
    uint row_x, row_y, row_z;
    PacketMask z_is_x, z_is_y; /* which axis is z of a ray; neither: z */
    int share_axes;            /* all rays have the same; row_x, row_y and row_z are of the first */
    int culls;
    uint instance;
} PacketSpace;

TRIAD_FUNCTION float packet_least(PacketFloat v) {
    const float4 four = v.lo < v.hi ? v.lo : v.hi;
    const float2 two = four.lo < four.hi ? four.lo : four.hi;
    return math_min(two.x, two.y);
}
TRIAD_FUNCTION float packet_greatest(PacketFloat v) {
    const float4 four = v.lo > v.hi ? v.lo : v.hi;
    const float2 two = four.lo > four.hi ? four.lo : four.hi;
    return math_max(two.x, two.y);
}

/* Bounds along an axis: t of a plane is (b - origin) * inverse, which for planes ahead is least for the
 * origin that is farthest on and the inverse that is smallest, and greatest for the others. Planes behind an
 * origin need no such care: to enter by them is to enter at once, and to leave by them is to miss. Where
 * directions differ in sign there is no bound: the box is entered at 0 and never left. */
TRIAD_FUNCTION void packet_bounds(PacketSpace* space, int axis, PacketFloat origin, PacketFloat inverse,
                                  int from_one_point) {
    const float least = packet_least(inverse), greatest = packet_greatest(inverse);
    const float low = from_one_point ? origin.s0 : packet_least(origin);
    const float high = from_one_point ? origin.s0 : packet_greatest(origin);
    const int backward = greatest < 0.0f;
    const int forward = least > 0.0f;
    space->enters.inverse[axis] = forward ? least : backward ? greatest : 0.0f;
    space->enters.offset[axis] = forward ? -high * least : backward ? -low * greatest : 0.0f;
    space->enters.near_row[axis] = (uint)axis * 16u + (backward ? 8u : 0u);
    space->leaves.inverse[axis] = forward ? greatest : backward ? least : 0.0f;
    space->leaves.offset[axis] = forward ? -low * greatest : backward ? -high * least : INFINITY;
}

/* x, y and z of every ray's own axes: triangle_ray(). */
TRIAD_FUNCTION void packet_permute(const PacketSpace* space, PacketFloat a, PacketFloat b, PacketFloat c,
                                   PacketFloat* x, PacketFloat* y, PacketFloat* z) {
    *x = space->z_is_x ? b : space->z_is_y ? c : a;
    *y = space->z_is_x ? c : space->z_is_y ? a : b;
    *z = space->z_is_x ? a : space->z_is_y ? b : c;
}

/* instance: 0 for the world. */
TRIAD_FUNCTION PacketSpace packet_space(const Traversal* scene, const Packet* rays, uint instance) {
    PacketFloat o[3] = {rays->origin[0], rays->origin[1], rays->origin[2]};
    PacketFloat d[3] = {rays->direction[0], rays->direction[1], rays->direction[2]};
#if TRIAD_INSTANCES
    if (instance != 0u) {
        global const float* m = scene->instances[instance].to_object;
#pragma unroll
        for (int row = 0; row < 3; ++row, m += 4) {
            o[row] = fma((PacketFloat)(m[0]), rays->origin[0],
                         fma((PacketFloat)(m[1]), rays->origin[1],
                             fma((PacketFloat)(m[2]), rays->origin[2], (PacketFloat)(m[3]))));
            d[row] = fma((PacketFloat)(m[0]), rays->direction[0],
                         fma((PacketFloat)(m[1]), rays->direction[1], m[2] * rays->direction[2]));
        }
    }
#else
    (void)scene;
#endif
    PacketSpace space;
    space.instance = instance;
    const PacketFloat x = fabs(d[0]), y = fabs(d[1]), z = fabs(d[2]);
    const PacketFloat xy = x > y ? x : y, least = (xy > z ? xy : z) * 0x1p-40f;
#pragma unroll
    for (int axis = 0; axis < 3; ++axis) { /* slab_inverse() */
        const PacketFloat size = axis == 0 ? x : axis == 1 ? y : z;
        const PacketMask sign = as_int8(d[axis]) & (PacketMask)((int)0x80000000);
        packet_bounds(&space, axis, o[axis], 1.0f / as_float8(as_int8(size > least ? size : least) | sign),
                      rays->from_one_point);
    }
    space.z_is_x = (x > y) & (x > z);
    space.z_is_y = ~(x > y) & (y > z);
    const ulong are_x = packet_lanes(space.z_is_x), are_y = packet_lanes(space.z_is_y);
    space.share_axes =
        (are_x == 0ul || are_x == 0x8080808080808080ul) && (are_y == 0ul || are_y == 0x8080808080808080ul);
    PacketFloat along;
    packet_permute(&space, o[0], o[1], o[2], &space.origin_x, &space.origin_y, &space.origin_z);
    packet_permute(&space, d[0], d[1], d[2], &space.shear_x, &space.shear_y, &along);
    space.shear_x = -(space.shear_x / along);
    space.shear_y = -(space.shear_y / along);
    space.shear_z = 1.0f / along;
    space.row_z = are_x ? 0u : are_y ? 4u : 8u;
    space.row_x = space.row_z == 8u ? 0u : space.row_z + 4u;
    space.row_y = space.row_x == 8u ? 0u : space.row_x + 4u;
    space.culls = space.share_axes && rays->from_one_point;
    space.shears_x[0] = packet_least(space.shear_x), space.shears_x[1] = packet_greatest(space.shear_x);
    space.shears_y[0] = packet_least(space.shear_y), space.shears_y[1] = packet_greatest(space.shear_y);
    return space;
}

#endif
#endif
