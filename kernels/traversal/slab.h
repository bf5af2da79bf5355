/* A ray against the boxes of a node.
 *
 * One fma per plane over boxes that the builder padded for its rounding (host/bvh/nodes.h), so that a box is
 * never missed whose triangle is hit, and a box's entry is never beyond the t of a triangle inside: results
 * do not depend on the order of visits, nor on the format of nodes.
 */
#ifndef TRIAD_TRAVERSAL_SLAB_H
#define TRIAD_TRAVERSAL_SLAB_H
#include "common/math.h"

/* What the slab test needs of a ray, once per ray and space. t of a plane at b is fma(b, inverse, -origin *
 * inverse). */
typedef struct SlabRay {
    float inverse[3];
    float offset[3]; /* -origin * inverse */
    uint
        near_row[3]; /* first float of the row of Bvh8Node.bounds that the ray meets first; the other one is ^
                        8 */
} SlabRay;

/* A component of zero becomes 2^-40 of the largest: finite, so that no plane yields 0 * inf, far below the
 * padding of the boxes, and relative, so that scaling by a power of two changes no bit. */
TRIAD_FUNCTION float slab_inverse(float component, float least) {
    return 1.0f / copysign(math_max(fabs(component), least), component);
}

/* Axis by axis, not in a loop: what a variable indexes lies in memory, and CPUs that write a few floats there
 * and read them at once as a vector wait (5 % of a path). */
TRIAD_FUNCTION SlabRay slab_ray(const float origin[3], const float direction[3]) {
    const float least = math_max(fabs(direction[0]), math_max(fabs(direction[1]), fabs(direction[2])));
    SlabRay ray;
    ray.inverse[0] = slab_inverse(direction[0], least * 0x1p-40f);
    ray.inverse[1] = slab_inverse(direction[1], least * 0x1p-40f);
    ray.inverse[2] = slab_inverse(direction[2], least * 0x1p-40f);
    ray.offset[0] = -origin[0] * ray.inverse[0];
    ray.offset[1] = -origin[1] * ray.inverse[1];
    ray.offset[2] = -origin[2] * ray.inverse[2];
    ray.near_row[0] = ray.inverse[0] < 0.0f ? 8u : 0u;
    ray.near_row[1] = ray.inverse[1] < 0.0f ? 24u : 16u;
    ray.near_row[2] = ray.inverse[2] < 0.0f ? 40u : 32u;
    return ray;
}

#if TRIAD_BVH4

/* The planes of four children along an axis, as t: byte c of `near` and `far` is of child c, and t of a byte
 * b is fma(b, cell, offset). */
typedef struct SlabAxis {
    float cell, offset;
    uint near, far;
} SlabAxis;

TRIAD_FUNCTION SlabAxis slab_axis(const SlabRay* ray, int axis, float origin, uint exponent, uint low,
                                  uint high) {
    const int backward = ray->inverse[axis] < 0.0f;
    SlabAxis s;
    s.cell = as_float(exponent << 23) * ray->inverse[axis];
    s.offset = fma(origin, ray->inverse[axis], ray->offset[axis]);
    s.near = backward ? high : low;
    s.far = backward ? low : high;
    return s;
}

TRIAD_FUNCTION float slab_plane(const SlabAxis* s, uint bytes, int child) {
    return fma((float)(bytes >> (8 * child) & 0xffu), s->cell, s->offset);
}

/* Four boxes: entry distances; INFINITY for those that the ray does not meet within [0, t_max]. */
TRIAD_FUNCTION void slab_intersect(global const Bvh4Node* node, const SlabRay* ray, float t_max,
                                   float entry[4], uint child[4]) {
    /* A node is four vectors of 16 bytes: as many loads. */
    global const uint4* words = (global const uint4*)node;
    const uint4 grid = words[0], xy = words[1], z = words[2], rest = words[3];
    const SlabAxis sx = slab_axis(ray, 0, as_float(grid.x), grid.w & 0xffu, xy.x, xy.y);
    const SlabAxis sy = slab_axis(ray, 1, as_float(grid.y), grid.w >> 8 & 0xffu, xy.z, xy.w);
    const SlabAxis sz = slab_axis(ray, 2, as_float(grid.z), grid.w >> 16 & 0xffu, z.x, z.y);
    child[0] = z.z;
    child[1] = z.w;
    child[2] = rest.x;
    child[3] = rest.y;
#pragma unroll
    for (int c = 0; c < 4; ++c) {
        const float tn = math_max(math_max(slab_plane(&sx, sx.near, c), slab_plane(&sy, sy.near, c)),
                                  math_max(slab_plane(&sz, sz.near, c), 0.0f));
        const float tf = math_min(math_min(slab_plane(&sx, sx.far, c), slab_plane(&sy, sy.far, c)),
                                  math_min(slab_plane(&sz, sz.far, c), t_max));
        /* An empty child is never met, whatever a ray that is no number compares like. */
        entry[c] = tn <= tf && child[c] != BVH_EMPTY ? tn : INFINITY;
    }
}

#else

/* t of the planes of eight boxes, in the row of Bvh8Node.bounds that begins with its float `row`. */
TRIAD_FUNCTION float8 slab_planes(global const Bvh8Node* node, uint row, const SlabRay* ray, int axis) {
    return fma(vload8(0, &node->bounds[0][0] + row), (float8)(ray->inverse[axis]),
               (float8)(ray->offset[axis]));
}

/* Eight boxes: entry distances, and the top bit of a byte for each child that the ray meets within [0,
 * t_max]. Of rays that are walked together (packet.h) `enters` meets near planes no later than any of them,
 * and `leaves` far planes no sooner; of one ray both are itself. */
TRIAD_FUNCTION ulong slab_intersect(global const Bvh8Node* node, const SlabRay* enters, const SlabRay* leaves,
                                    float t_max, float8* entry) {
    const float8 nx = slab_planes(node, enters->near_row[0], enters, 0);
    const float8 ny = slab_planes(node, enters->near_row[1], enters, 1);
    const float8 nz = slab_planes(node, enters->near_row[2], enters, 2);
    const float8 fx = slab_planes(node, enters->near_row[0] ^ 8u, leaves, 0);
    const float8 fy = slab_planes(node, enters->near_row[1] ^ 8u, leaves, 1);
    const float8 fz = slab_planes(node, enters->near_row[2] ^ 8u, leaves, 2);
    /* Ternaries, not fmin and fmax: these are one instruction each. Of rays no operand is NaN but where a
     * child is empty, of which some far plane is left. */
    float8 tn = nx > ny ? nx : ny, tf = fx < fy ? fx : fy;
    tn = tn > nz ? tn : nz;
    tf = tf < fz ? tf : fz;
    tn = tn > 0.0f ? tn : (float8)(0.0f);
    /* This way round NaN stays NaN: the far planes of an empty child are -inf or NaN whatever the ray is. */
    tf = t_max < tf ? (float8)(t_max) : tf;
    *entry = tn;
    return as_ulong(convert_char8(tn <= tf)) & 0x8080808080808080ul;
}

/* Takes the lowest child out of a mask of slab_intersect and returns its number. */
TRIAD_FUNCTION uint slab_next(ulong* mask) {
    const uint child = (uint)(63 - clz(*mask & (0 - *mask))) >> 3;
    *mask &= *mask - 1;
    return child;
}

#endif
#endif
