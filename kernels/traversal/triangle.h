/* A ray against a block: all of its four triangles at once, or (TRIAD_BVH4) one. The test is edges.h. */
#ifndef TRIAD_TRAVERSAL_TRIANGLE_H
#define TRIAD_TRAVERSAL_TRIANGLE_H
#include "traversal/edges.h"

/* What the test needs of a ray, once per ray and space: axes permuted so that z is the direction's largest
 * (edges.h; section 3.1), the shear that maps the direction to (0, 0, 1), and the rows of
 * TriangleBlock.vertex that hold the permuted axes. */
typedef struct TriangleRay {
    float origin_x, origin_y, origin_z;
    float shear_x, shear_y, shear_z;
    uint row_x, row_y, row_z; /* in floats from vertex[0][0]; corners are 12 floats apart */
} TriangleRay;

/* A value of each triangle that is tested at once, a truth (0 or not) of each, and where the test reads them:
 * `row` points to a corner's coordinate in the first lane. */
#if TRIAD_BVH4
typedef float TriangleFloat;
typedef int TriangleMask;
#define TRIANGLE_LOAD(lane, row) (row)[lane]
#else
typedef float4 TriangleFloat;
typedef int4 TriangleMask;
#define TRIANGLE_LOAD(lane, row) vload4(0, (row) + (lane))
#endif

typedef struct TriangleHits {
    TriangleFloat t, u, v;
} TriangleHits;

TRIANGLE_DIFFERENCE_OF_PRODUCTS(triangle_difference_of_products, TriangleFloat)

/* Of four triangles some are hit. */
#if TRIAD_BVH4
#define TRIANGLE_STOP(lanes) \
    if (!lanes) return 0
#else
#define TRIANGLE_STOP(lanes)
#endif

/* One of three by an index. Where items are the lanes it is not read from an array, which would be one in
 * memory; a CPU reads it from there sooner than it has chosen. */
TRIAD_FUNCTION float triangle_pick(uint axis, const float values[3]) {
#if TRIAD_BVH4
    return axis == 0u ? values[0] : axis == 1u ? values[1] : values[2];
#else
    return values[axis];
#endif
}

TRIAD_FUNCTION TriangleRay triangle_ray(const float origin[3], const float direction[3]) {
    const float x = fabs(direction[0]), y = fabs(direction[1]), z = fabs(direction[2]);
    const uint kz = x > y ? (x > z ? 0u : 2u) : (y > z ? 1u : 2u);
    const uint kx = kz == 2u ? 0u : kz + 1u;
    const uint ky = kx == 2u ? 0u : kx + 1u;
    TriangleRay ray;
    const float along = triangle_pick(kz, direction);
    ray.origin_x = triangle_pick(kx, origin);
    ray.origin_y = triangle_pick(ky, origin);
    ray.origin_z = triangle_pick(kz, origin);
    ray.shear_x = triangle_pick(kx, direction) / along;
    ray.shear_y = triangle_pick(ky, direction) / along;
    ray.shear_z = 1.0f / along;
    ray.row_x = kx * 4u;
    ray.row_y = ky * 4u;
    ray.row_z = kz * 4u;
    return ray;
}

/* Which of the triangles from `lane` of `block` on are hit with 0 < t <= t_max and are not the primitive
 * `skip`; their t, u, v in `hits`. Both sides count; an edge counts for both its triangles; a triangle
 * without area is never hit. */
TRIAD_FUNCTION TriangleMask triangle_intersect(global const TriangleBlock* block, uint lane,
                                               const TriangleRay* ray, float t_max, uint skip,
                                               TriangleHits* hits) {
    global const float* x = &block->vertex[0][0] + ray->row_x;
    global const float* y = &block->vertex[0][0] + ray->row_y;
    global const float* z = &block->vertex[0][0] + ray->row_z;
    const TriangleFloat az = TRIANGLE_LOAD(lane, z) - ray->origin_z;
    const TriangleFloat bz = TRIANGLE_LOAD(lane, z + 12) - ray->origin_z;
    const TriangleFloat cz = TRIANGLE_LOAD(lane, z + 24) - ray->origin_z;
    const TriangleFloat sx = (TriangleFloat)(-ray->shear_x), sy = (TriangleFloat)(-ray->shear_y);
    const TriangleFloat ax = fma(sx, az, TRIANGLE_LOAD(lane, x) - ray->origin_x);
    const TriangleFloat ay = fma(sy, az, TRIANGLE_LOAD(lane, y) - ray->origin_y);
    const TriangleFloat bx = fma(sx, bz, TRIANGLE_LOAD(lane, x + 12) - ray->origin_x);
    const TriangleFloat by = fma(sy, bz, TRIANGLE_LOAD(lane, y + 12) - ray->origin_y);
    const TriangleFloat cx = fma(sx, cz, TRIANGLE_LOAD(lane, x + 24) - ray->origin_x);
    const TriangleFloat cy = fma(sy, cz, TRIANGLE_LOAD(lane, y + 24) - ray->origin_y);
    const float shear_z = ray->shear_z;
    TRIANGLE_EDGES(TriangleFloat, TriangleMask, triangle_difference_of_products, TRIANGLE_STOP);
    return lanes & (t > 0.0f) & (t <= t_max) & (TRIANGLE_LOAD(lane, block->primitive) != skip);
}

#endif
