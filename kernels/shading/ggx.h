/* The GGX microfacet distribution (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014), in
 * a local frame whose +z is the surface normal. alpha = roughness^2, 1e-4 <= alpha <= 1; functions that end
 * in _xy take one along x and one along y (the others would lose digits by it, or time).
 *
 * With s(w) = sqrt(alpha^2 (x^2 + y^2) + z^2) = |z| (1 + 2 Lambda(w)), every masking term is a ratio of sums
 * without cancellation: G1(w) = 2 z / (z + s), G2(o, i) = 2 z_o z_i / (z_i s_o + z_o s_i).
 */
#ifndef TRIAD_SHADING_GGX_H
#define TRIAD_SHADING_GGX_H

#include "common/vector.h"

/* D of the direction h, which need not be normalised: alpha^2 / (pi (x^2 + y^2 + alpha^2 z^2)^2) for a unit
 * h. The usual form with cos^2 (alpha^2 - 1) + 1 loses everything below alpha 1e-3. */
TRIAD_FUNCTION float ggx_distribution(Vec3 h, float alpha) {
    float xy = fma(h.x, h.x, h.y * h.y), z = h.z * h.z;
    float q = alpha * (xy + z) / fma(alpha * alpha, z, xy);
    return q * q * MATH_INV_PI;
}

/* s(w). */
TRIAD_FUNCTION float ggx_stretch(Vec3 w, float alpha) {
    return sqrt(fma(alpha * alpha, fma(w.x, w.x, w.y * w.y), w.z * w.z));
}

TRIAD_FUNCTION float ggx_distribution_xy(Vec3 h, float alpha_x, float alpha_y) {
    float x = h.x * alpha_y, y = h.y * alpha_x, product = alpha_x * alpha_y;
    float z2 = h.z * h.z, l2 = fma(h.x, h.x, fma(h.y, h.y, z2));
    float q = l2 * product / fma(x, x, fma(y, y, product * product * z2));
    return q * q * product * MATH_INV_PI;
}
TRIAD_FUNCTION float ggx_stretch_xy(Vec3 w, float alpha_x, float alpha_y) {
    float x = w.x * alpha_x, y = w.y * alpha_y;
    return sqrt(fma(x, x, fma(y, y, w.z * w.z)));
}

/* Lower bound k of the spherical cap that reflects above the horizon (Eto and Tokuyoshi 2023, eq. 5); 1 =
 * unbounded. Of two alphas the smaller one is meant. */
TRIAD_FUNCTION float ggx_cap(Vec3 wo, float alpha) {
    float s2 = math_square(1.0f + sqrt(fma(wo.x, wo.x, wo.y * wo.y)));
    float a2 = alpha * alpha;
    return (1.0f - a2) * s2 / fma(a2, wo.z * wo.z, s2);
}

/* A visible normal for wo (wo.z >= 0), stretch = s(wo): spherical caps (Dupuy and Benyoub 2023), cut at k (1:
 * whole). Unit, z > 0, and on wo's side. */
TRIAD_FUNCTION Vec3 ggx_sample_xy(Vec3 wo, float alpha_x, float alpha_y, float stretch, float k, Vec2 u) {
    float inv = 1.0f / stretch;
    Vec3 w = vec3_make(alpha_x * wo.x * inv, alpha_y * wo.y * inv, wo.z * inv);
    /* h = cap point + w; sums of positive terms for h.z and 1 + z: at small alpha their cancellation would
     * turn h away */
    float h_z = fma(1.0f - u.y, fma(k, w.z, 1.0f), (1.0f - k) * w.z);
    float one_plus_z = h_z + fma(w.x, w.x, w.y * w.y) / (1.0f + w.z);
    float r = math_sqrt((1.0f + w.z - h_z) * one_plus_z);
    float s, c;
    math_sincos_turns(u.x, &s, &c);
    Vec3 h = vec3_make(alpha_x * fma(r, c, w.x), alpha_y * fma(r, s, w.y), h_z);
    return vec3_normalize(h);
}
TRIAD_FUNCTION Vec3 ggx_sample(Vec3 wo, float alpha, float stretch, float k, Vec2 u) {
    return ggx_sample_xy(wo, alpha, alpha, stretch, k, u);
}

/* Density over solid angle of the reflection of wo about ggx_sample's normal, from d = D(h): the factor 1 /
 * (4 wo.h) and wo.h cancel. */
TRIAD_FUNCTION float ggx_reflection_pdf(float d, float z_o, float stretch_o, float k) {
    return d / (2.0f * fma(k, z_o, stretch_o));
}
/* Density over solid angle of the visible normal itself. */
TRIAD_FUNCTION float ggx_normal_pdf(float d, float wo_h, float z_o, float stretch_o) {
    return 2.0f * d * wo_h / (z_o + stretch_o);
}
/* G2 / z_o: the masking of both directions over the cosine of wo; z_i = |cos| of wi. */
TRIAD_FUNCTION float ggx_masking(float z_o, float stretch_o, float z_i, float stretch_i) {
    return 2.0f * z_i / fma(z_i, stretch_o, z_o * stretch_i);
}

#endif
