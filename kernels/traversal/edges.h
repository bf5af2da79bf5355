/* The test of a ray against a triangle once both are in the ray's own axes: one text for all widths, as
 * macros, since each file is included once. FLOAT: a value of each pair of a ray and a triangle that is
 * tested at once; MASK: a truth (0 or not) of each. Woop, Benthin, Wald: Watertight Ray/Triangle
 * Intersection, JCGT 2(1), 2013. The edge functions are differences of products compensated with fma (Kahan;
 * error <= 1.5 ulp, so the sign is exact), which replaces the paper's fall-back to double: neighbours that
 * share an edge always agree on which side of it the ray passes. */
#ifndef TRIAD_TRAVERSAL_EDGES_H
#define TRIAD_TRAVERSAL_EDGES_H
#include "common/language.h"

/* clang-format off */

/* Defines NAME: a b - c d, relative error <= 1.5 ulp (Jeannerod, Louvet, Muller 2013, algorithm 2). */
#define TRIANGLE_DIFFERENCE_OF_PRODUCTS(NAME, FLOAT)                   \
    TRIAD_FUNCTION FLOAT NAME(FLOAT a, FLOAT b, FLOAT c, FLOAT d) {    \
        const FLOAT cd = c * d;                                        \
        return fma(a, b, -cd) + fma(-c, d, cd);                        \
    }

/* Within a function that has ax to cz, the corners from the ray's origin on, sheared so that the ray runs along
 * z; shear_z, which takes z to t; and `hits`. Declares `lanes`, those that are hit, be it behind the origin, and
 * their `t`, which it writes to `hits` with u and v. Both sides count; an edge counts for both its triangles; a
 * triangle without area is never hit. STOP(lanes): what is done before the division, which few pairs need. */
#define TRIANGLE_EDGES(FLOAT, MASK, DIFFERENCE_OF_PRODUCTS, STOP)                                  \
    const FLOAT u = DIFFERENCE_OF_PRODUCTS(cx, by, cy, bx);                                        \
    const FLOAT v = DIFFERENCE_OF_PRODUCTS(ax, cy, ay, cx);                                        \
    const FLOAT w = DIFFERENCE_OF_PRODUCTS(bx, ay, by, ax);                                        \
    FLOAT least = u < v ? u : v, most = u > v ? u : v;                                             \
    least = least < w ? least : w;                                                                 \
    most = most > w ? most : w;                                                                    \
    const FLOAT determinant = u + v + w;                                                           \
    const MASK lanes = ((least >= 0.0f) | (most <= 0.0f)) & (determinant != 0.0f);                 \
    STOP(lanes);                                                                                   \
    const FLOAT inverse = 1.0f / determinant;                                                      \
    const FLOAT t = fma(u, az, fma(v, bz, w * cz)) * shear_z * inverse;                            \
    hits->t = t;                                                                                   \
    hits->u = v * inverse;                                                                         \
    hits->v = w * inverse

/* clang-format on */

#endif
