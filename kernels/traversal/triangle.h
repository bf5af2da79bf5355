/* Watertight ray-triangle test, four triangles at once.
 * Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013. The edge functions are
 * differences of products compensated with fma (Kahan; error <= 1.5 ulp, so the sign is exact), which
 * replaces the paper's fall-back to double: neighbours that share an edge always agree on which side of it
 * the ray passes.
 */
#ifndef TRIAD_TRAVERSAL_TRIANGLE_H
#define TRIAD_TRAVERSAL_TRIANGLE_H
#include "common/language.h"

/* What the test needs of a ray, once per ray and space: axes permuted so that z is the direction's largest
 * (section 3.1), the shear that maps the direction to (0, 0, 1), and the rows of TriangleBlock.vertex that
 * hold the permuted axes. */
typedef struct TriangleRay {
    float origin_x, origin_y, origin_z;
    float shear_x, shear_y, shear_z;
    uint row_x, row_y, row_z; /* in floats from vertex[0][0]; corners are 12 floats apart */
} TriangleRay;

typedef struct TriangleHits {
    float4 t, u, v;
} TriangleHits;

TRIAD_FUNCTION TriangleRay triangle_ray(const float origin[3], const float direction[3]) {
    const float x = fabs(direction[0]), y = fabs(direction[1]), z = fabs(direction[2]);
    const uint kz = x > y ? (x > z ? 0u : 2u) : (y > z ? 1u : 2u);
    const uint kx = kz == 2u ? 0u : kz + 1u;
    const uint ky = kx == 2u ? 0u : kx + 1u;
    TriangleRay ray;
    ray.origin_x = origin[kx];
    ray.origin_y = origin[ky];
    ray.origin_z = origin[kz];
    ray.shear_x = direction[kx] / direction[kz];
    ray.shear_y = direction[ky] / direction[kz];
    ray.shear_z = 1.0f / direction[kz];
    ray.row_x = kx * 4u;
    ray.row_y = ky * 4u;
    ray.row_z = kz * 4u;
    return ray;
}

/* a b - c d, relative error <= 1.5 ulp (Jeannerod, Louvet, Muller 2013, algorithm 2). */
TRIAD_FUNCTION float4 triangle_difference_of_products(float4 a, float4 b, float4 c, float4 d) {
    const float4 cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

/* Lanes (-1 or 0) of `block` hit with 0 < t <= t_max that are not the primitive `skip`; their t, u, v in
 * `hits`. Both sides count; an edge counts for both its triangles; a triangle without area is never hit. */
TRIAD_FUNCTION int4 triangle_intersect(global const TriangleBlock* block, const TriangleRay* ray, float t_max,
                                       uint skip, TriangleHits* hits) {
    global const float* x = &block->vertex[0][0] + ray->row_x;
    global const float* y = &block->vertex[0][0] + ray->row_y;
    global const float* z = &block->vertex[0][0] + ray->row_z;
    const float4 az = vload4(0, z) - ray->origin_z;
    const float4 bz = vload4(3, z) - ray->origin_z;
    const float4 cz = vload4(6, z) - ray->origin_z;
    const float4 sx = (float4)(-ray->shear_x), sy = (float4)(-ray->shear_y);
    const float4 ax = fma(sx, az, vload4(0, x) - ray->origin_x);
    const float4 ay = fma(sy, az, vload4(0, y) - ray->origin_y);
    const float4 bx = fma(sx, bz, vload4(3, x) - ray->origin_x);
    const float4 by = fma(sy, bz, vload4(3, y) - ray->origin_y);
    const float4 cx = fma(sx, cz, vload4(6, x) - ray->origin_x);
    const float4 cy = fma(sy, cz, vload4(6, y) - ray->origin_y);

    const float4 u = triangle_difference_of_products(cx, by, cy, bx);
    const float4 v = triangle_difference_of_products(ax, cy, ay, cx);
    const float4 w = triangle_difference_of_products(bx, ay, by, ax);
    float4 least = u < v ? u : v, most = u > v ? u : v;
    least = least < w ? least : w;
    most = most > w ? most : w;
    const float4 determinant = u + v + w;
    int4 lanes = ((least >= 0.0f) | (most <= 0.0f)) & (determinant != 0.0f);

    const float4 inverse = 1.0f / determinant;
    const float4 t = fma(u, az, fma(v, bz, w * cz)) * ray->shear_z * inverse;
    hits->t = t;
    hits->u = v * inverse;
    hits->v = w * inverse;
    return lanes & (t > 0.0f) & (t <= t_max) & (vload4(0, block->primitive) != skip);
}

#endif
