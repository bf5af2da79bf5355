/* An orthonormal frame about a unit vector (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"). */
#ifndef TRIAD_COMMON_FRAME_H
#define TRIAD_COMMON_FRAME_H

#include "common/vector.h"

typedef struct ShadingFrame {
    Vec3 x, y, z;
} ShadingFrame;

/* Right-handed, z = n. Orthonormal to 1e-6 for every unit n, -z included. */
TRIAD_FUNCTION ShadingFrame frame_make(Vec3 n) {
    float sign = as_float((as_uint(n.z) & 0x80000000u) | 0x3f800000u);
    float a = -1.0f / (sign + n.z);
    float b = n.x * n.y * a;
    ShadingFrame f;
    f.x = vec3_make(fma(sign * n.x * n.x, a, 1.0f), sign * b, -sign * n.x);
    f.y = vec3_make(b, fma(n.y * n.y, a, sign), -n.y);
    f.z = n;
    return f;
}
/* The same with x along the part of v that is across n, where there is one. */
TRIAD_FUNCTION ShadingFrame frame_make_along(Vec3 n, Vec3 v) {
    ShadingFrame f = frame_make(n);
    const Vec3 across = vec3_add_scaled(v, n, -vec3_dot(v, n));
    const float l2 = vec3_dot(across, across);
    if (l2 > 1e-12f) {
        f.x = vec3_scale(across, 1.0f / sqrt(l2));
        f.y = vec3_cross(n, f.x);
    }
    return f;
}
TRIAD_FUNCTION Vec3 frame_to_local(const ShadingFrame* f, Vec3 v) {
    return vec3_make(vec3_dot(v, f->x), vec3_dot(v, f->y), vec3_dot(v, f->z));
}
TRIAD_FUNCTION Vec3 frame_to_world(const ShadingFrame* f, Vec3 v) {
    return vec3_fma_scale(v.x, f->x, vec3_fma_scale(v.y, f->y, vec3_scale(f->z, v.z)));
}

#endif
