/* The scene as kernels see it: one private struct of the global arrays of arguments.h, so that functions take
 * one pointer (it inlines away). */
#ifndef TRIAD_SHADING_SCENE_H
#define TRIAD_SHADING_SCENE_H

#include "common/parameters.h"
#include "common/vector.h"

typedef struct Scene {
    SCENE_LIST(PARAMETER_MEMBER, PARAMETER_MEMBER)
} Scene;

#define SCENE_FROM_PARAMETERS \
    { SCENE_ARGUMENTS }

/* Matrices are 3x4, row-major. */
TRIAD_FUNCTION Vec3 transform_point(global const float* m, Vec3 p) {
    return vec3_make(fma(m[0], p.x, fma(m[1], p.y, fma(m[2], p.z, m[3]))),
                     fma(m[4], p.x, fma(m[5], p.y, fma(m[6], p.z, m[7]))),
                     fma(m[8], p.x, fma(m[9], p.y, fma(m[10], p.z, m[11]))));
}
TRIAD_FUNCTION Vec3 transform_vector(global const float* m, Vec3 v) {
    return vec3_make(fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z)), fma(m[4], v.x, fma(m[5], v.y, m[6] * v.z)),
                     fma(m[8], v.x, fma(m[9], v.y, m[10] * v.z)));
}
/* By the transpose of the linear part: with the inverse matrix, how normals go. */
TRIAD_FUNCTION Vec3 transform_normal(global const float* inverse, Vec3 n) {
    return vec3_make(fma(inverse[0], n.x, fma(inverse[4], n.y, inverse[8] * n.z)),
                     fma(inverse[1], n.x, fma(inverse[5], n.y, inverse[9] * n.z)),
                     fma(inverse[2], n.x, fma(inverse[6], n.y, inverse[10] * n.z)));
}

/* v times a power of two that brings its largest component into [1, 2); zero and non-finite vectors stay.
 * Exact, so that scaling v by a power of two changes no bit of what follows, and no later square under- or
 * overflows. */
TRIAD_FUNCTION Vec3 scale_to_one(Vec3 v) {
    const uint exponent = as_uint(vec3_largest_abs(v)) & 0x7f800000u;
    return exponent == 0u || exponent >= 0x7f000000u ? v : vec3_scale(v, as_float(0x7f000000u - exponent));
}

/* v / |v|, or `fallback` when v is zero or not finite. */
TRIAD_FUNCTION Vec3 normalize_or(Vec3 v, Vec3 fallback) {
    Vec3 scaled = v;
    float length2 = vec3_dot(v, v);
    if (!(length2 > 0x1.0p-80f && length2 < 0x1.0p80f)) { /* rare; scaling by a power of two changes no bit */
        scaled = scale_to_one(v);
        length2 = vec3_dot(scaled, scaled);
        if (!(length2 >= 1.0f && length2 < 16.0f)) return fallback;
    }
    return vec3_scale(scaled, 1.0f / sqrt(length2));
}

#endif
