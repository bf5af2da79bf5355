/* Reflectance of smooth interfaces, for unpolarised light. */
#ifndef TRIAD_SHADING_FRESNEL_H
#define TRIAD_SHADING_FRESNEL_H

#include "common/math.h"

/* Reflectance at normal incidence of relative index n >= 0; 1 at n = 0 (KHR_materials_ior). */
TRIAD_FUNCTION float fresnel_normal(float n) { return math_square((n - 1.0f) / (n + 1.0f)); }

/* (1 - c)^5 of Schlick 1994. */
TRIAD_FUNCTION float fresnel_schlick_weight(float c) {
    float m = math_saturate(1.0f - c);
    return math_square(math_square(m)) * m;
}

/* Dielectric interface: c >= 0 is the cosine on the side the light comes from, eta > 0 the index beyond the
 * interface over the index before it. 1 under total reflection. Cook and Torrance 1982 eq. 16, with g - c
 * taken as (eta^2 - 1) / (g + c), so that nothing cancels at eta near 1; relative error 2e-6 away from total
 * reflection. */
TRIAD_FUNCTION float fresnel_dielectric(float c, float eta) {
    float e = (eta - 1.0f) * (eta + 1.0f);
    float g2 = fma(c, c, e);
    if (g2 <= 0.0f) return e == 0.0f ? 0.0f : 1.0f;
    float sum = sqrt(g2) + c;
    float difference = e / sum; /* g - c */
    float b = fma(c, sum, -1.0f) / fma(c, difference, 1.0f);
    return 0.5f * math_square(difference / sum) * fma(b, b, 1.0f);
}

/* Cosine beyond the interface; 0 under total reflection. */
TRIAD_FUNCTION float fresnel_refracted_cosine(float c, float eta) {
    return math_sqrt(fma(c, c, (eta - 1.0f) * (eta + 1.0f))) / eta;
}

#endif
