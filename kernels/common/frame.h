/* An orthonormal frame about a unit vector (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"). */
#ifndef TRIAD_COMMON_FRAME_H
#define TRIAD_COMMON_FRAME_H

#include "common/math.h"

typedef struct ShadingFrame {
    float3 x, y, z;
} ShadingFrame;

/* Right-handed, z = n. Orthonormal to 1e-6 for every unit n, -z included. */
TRIAD_FUNCTION ShadingFrame frame_make(float3 n) {
    float sign = as_float((as_uint(n.z) & 0x80000000u) | 0x3f800000u);
    float a = -1.0f / (sign + n.z);
    float b = n.x * n.y * a;
    ShadingFrame f;
    f.x = (float3)(fma(sign * n.x * n.x, a, 1.0f), sign * b, -sign * n.x);
    f.y = (float3)(b, fma(n.y * n.y, a, sign), -n.y);
    f.z = n;
    return f;
}
TRIAD_FUNCTION float3 frame_to_local(const ShadingFrame* f, float3 v) {
    return (float3)(math_dot(v, f->x), math_dot(v, f->y), math_dot(v, f->z));
}
TRIAD_FUNCTION float3 frame_to_world(const ShadingFrame* f, float3 v) {
    return fma((float3)(v.x), f->x, fma((float3)(v.y), f->y, (float3)(v.z) * f->z));
}

#endif
