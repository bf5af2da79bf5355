/* Mappings of the unit square to the shapes that are sampled. Each is continuous, so that well distributed
 * points stay well distributed. Directions are in a local frame about +z. */
#ifndef TRIAD_COMMON_SAMPLING_H
#define TRIAD_COMMON_SAMPLING_H

#include "common/vector.h"

/* Unit disc, uniform: pdf 1 / pi (Shirley and Chiu 1997). */
TRIAD_FUNCTION Vec2 sampling_disc(Vec2 u) {
    float a = fma(2.0f, u.x, -1.0f), b = fma(2.0f, u.y, -1.0f);
    if (a == 0.0f && b == 0.0f) return vec2_make(0.0f, 0.0f);
    uint steep = fabs(b) > fabs(a);
    float r = steep ? b : a, other = steep ? a : b;
    float s, c;
    math_sincos_octant(0.785398163f * (other / r), &s, &c);
    s *= r, c *= r;
    return vec2_make(steep ? s : c, steep ? c : s);
}

/* Hemisphere about +z with pdf z / pi. z > 0. */
TRIAD_FUNCTION Vec3 sampling_cosine(Vec2 u) {
    Vec2 d = sampling_disc(u);
    float z2 = 1.0f - fma(d.x, d.x, d.y * d.y);
    return vec3_make(d.x, d.y, sqrt(math_max(z2, 1e-14f)));
}
TRIAD_FUNCTION float sampling_cosine_pdf(float z) { return math_max(z, 0.0f) * MATH_INV_PI; }

/* Chooses with probability p by *u, uniform in [0, 1), and leaves in *u where it lies in what chose: uniform
 * again. So points that lie evenly still do so within every choice, where a number of its own for the choice
 * would draw at random who gets which of them. p 0 and 1 change nothing. */
TRIAD_FUNCTION uint sampling_choose(float* u, float p) {
    const uint chosen = *u < p;
    const float within = chosen ? *u / p : (*u - p) / (1.0f - p);
    *u = math_min(within, 0x1.fffffep-1f);
    return chosen;
}

/* Barycentric weights of corners 1 and 2 of a triangle, uniform: pdf 1 / area (Heitz 2019, "A Low-Distortion
 * Map Between Triangle and Square"). */
TRIAD_FUNCTION Vec2 sampling_triangle(Vec2 u) {
    const float half_least = 0.5f * math_min(u.x, u.y);
    return vec2_make(u.x - half_least, u.y - half_least);
}

/* The half sphere about z: pdf 1 / (2 pi). z > 0. */
TRIAD_FUNCTION Vec3 sampling_hemisphere(Vec2 u) {
    float z = 1.0f - u.x, s, c;
    float r = sqrt(u.x * (1.0f + z));
    math_sincos_turns(u.y, &s, &c);
    return vec3_make(r * c, r * s, z);
}

/* Whole sphere: pdf 1 / (4 pi). */
TRIAD_FUNCTION Vec3 sampling_sphere(Vec2 u) {
    float t = 2.0f * u.x; /* 1 - z, in [0, 2) */
    float r = sqrt(t * (2.0f - t));
    float s, c;
    math_sincos_turns(u.y, &s, &c);
    return vec3_make(r * c, r * s, 1.0f - t);
}

/* 1 - cos of the half angle whose squared sine is sin2, without the cancellation that loses small cones; at
 * most a right angle. */
TRIAD_FUNCTION float sampling_one_minus_cos(float sin2) { return sin2 / (1.0f + math_sqrt(1.0f - sin2)); }

/* Cone about +z: pdf 1 / (2 pi one_minus_cos). */
TRIAD_FUNCTION Vec3 sampling_cone(Vec2 u, float one_minus_cos) {
    float t = u.x * one_minus_cos;
    float r = sqrt(t * (2.0f - t));
    float s, c;
    math_sincos_turns(u.y, &s, &c);
    return vec3_make(r * c, r * s, 1.0f - t);
}
TRIAD_FUNCTION float sampling_cone_pdf(float one_minus_cos) { return 0.5f * MATH_INV_PI / one_minus_cos; }

#endif
