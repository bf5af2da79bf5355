/* The sRGB transfer curve (IEC 61966-2-1:1999). */
#ifndef TRIAD_SRGB_H
#define TRIAD_SRGB_H

#include "common/vector.h"

/* Display-linear [0, 1] to encoded; 1 gives 1 to an ulp. */
TRIAD_FUNCTION float srgb_encode(float v) {
    return v <= 0.0031308f ? 12.92f * v : fma(1.055f, math_pow(v, 1.0f / 2.4f), -0.055f);
}
TRIAD_FUNCTION float srgb_decode(float e) {
    return e <= 0.04045f ? e * (1.0f / 12.92f) : math_pow((e + 0.055f) * (1.0f / 1.055f), 2.4f);
}
TRIAD_FUNCTION Vec3 srgb_encode3(Vec3 v) {
    return vec3_make(srgb_encode(v.x), srgb_encode(v.y), srgb_encode(v.z));
}
TRIAD_FUNCTION Vec3 srgb_decode3(Vec3 e) {
    return vec3_make(srgb_decode(e.x), srgb_decode(e.y), srgb_decode(e.z));
}

#endif
