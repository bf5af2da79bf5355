/* KHR_materials_iridescence: the reflectance of a thin film between air and a base whose reflectance at
 * normal incidence is given. Exact for smooth, clear films (Airy 1833), all reflections and both
 * polarisations:
 *
 *   R = 1 - (1 - r12^2) (1 - r23^2) / (1 - x^2) (1 + 2 sum_m (-x)^m cos(m phi)),  x = r12 r23,
 *
 * with phi = 2 pi D / lambda of the optical path difference D = 2 n d cos. In colours the mean of cos(2 pi m
 * D / lambda) over the response of a channel is a function of m D alone: a table (Belcour and Barla 2017 take
 * Gaussians in its place). The base has a real index: (1 + sqrt(F0)) / (1 - sqrt(F0)). */
#ifndef TRIAD_SHADING_THIN_FILM_H
#define TRIAD_SHADING_THIN_FILM_H

#include "common/vector.h"
#include "shading/bsdf_input.h"
#include "shading/fresnel.h"

#if BSDF_FILM
/* Beyond it, in nm, float does not tell the phases of a wavelength apart, nor is light as coherent as that.
 */
#define FILM_MOST_DIFFERENCE 1e8f

/* What cos(m phi) is in the mean at one channel of colours, m from 1 to FILM_ORDERS; at one wavelength it is
 * had from the difference whenever it is needed, which takes fewer registers. */
typedef struct FilmPhase {
#if TRIAD_HERO
    float difference, wavelength;
#else
    float cosines[FILM_ORDERS];
#endif
} FilmPhase;
TRIAD_FUNCTION float film_cosine(const FilmPhase* phase, uint m) {
#if TRIAD_HERO
    const float difference = phase->difference * (float)m;
    return difference < FILM_MOST_DIFFERENCE ? math_cos_turns(difference / phase->wavelength) : 0.0f;
#else
    return phase->cosines[m - 1u];
#endif
}
#if !TRIAD_HERO
TRIAD_FUNCTION Vec3 film_cosines(const FilmInput* film, float difference) {
    const float x = difference * (1.0f / FILM_STEP);
    if (!(x < (float)(FILM_ROWS - 1))) return vec3_splat(0.0f);
    const uint i = (uint)x;
    global const float* row = film->responses + 3u * i;
    return vec3_mix(vec3_load(row, 0u), vec3_load(row, 1u), x - (float)i);
}
#endif

/* The sum from an order m on, where it is `sum` from the next one on (Horner); cosine: of cos(m phi). */
TRIAD_FUNCTION float film_sum(float r12, float r23, float cosine, float sum) {
    return -r12 * r23 * (cosine + sum);
}
/* 1 - R of one polarisation, whose sum over m is `sum`. */
TRIAD_FUNCTION float film_transmitted(float r12, float r23, float sum) {
    const float x = r12 * r23;
    return (1.0f + 2.0f * sum) * (1.0f - r12 * r12) * (1.0f - r23 * r23) / math_max(1.0f - x * x, 1e-6f);
}

/* One channel; c1, c2: cosines in air and in the film. */
TRIAD_FUNCTION float film_channel(float ior, float f0, float c1, float c2, const FilmPhase* phase) {
    const float root = sqrt(math_min(f0, 0.9998f)), base = (1.0f + root) / (1.0f - root);
    const float c3 = fresnel_refracted_cosine(c1, base);
    const float s12 = (c1 - ior * c2) / (c1 + ior * c2), p12 = (ior * c1 - c2) / (ior * c1 + c2);
    const float s23 = (ior * c2 - base * c3) / (ior * c2 + base * c3),
                p23 = (base * c2 - ior * c3) / (base * c2 + ior * c3);
    float s = 0.0f, p = 0.0f;
    for (uint m = FILM_ORDERS; m > 0u; --m) {
        const float cosine = film_cosine(phase, m);
        s = film_sum(s12, s23, cosine, s);
        p = film_sum(p12, p23, cosine, p);
    }
    const float through = film_transmitted(s12, s23, s) + film_transmitted(p12, p23, p);
    return math_saturate(1.0f - 0.5f * through);
}

/* c: cosine in air; f0: of the base without the film. */
TRIAD_FUNCTION_PER_CALL Colour film_reflectance(const FilmInput* film, Colour f0, float c) {
    const float ior = film->ior, c1 = math_max(math_min(c, 1.0f), 1e-4f);
    const float c2 = fresnel_refracted_cosine(c1, ior);
    const float difference = 2.0f * ior * film->thickness * c2;
    Colour r;
#if TRIAD_HERO
    const Vec4 w = film->wavelengths;
    const FilmPhase x = {difference, w.x}, y = {difference, w.y}, z = {difference, w.z},
                    last = {difference, w.w};
    r.w = film_channel(ior, f0.w, c1, c2, &last);
#else
    FilmPhase x, y, z;
    for (uint m = 1u; m <= FILM_ORDERS; ++m) {
        const Vec3 cosines = film_cosines(film, difference * (float)m);
        x.cosines[m - 1u] = cosines.x, y.cosines[m - 1u] = cosines.y, z.cosines[m - 1u] = cosines.z;
    }
#endif
    r.x = film_channel(ior, f0.x, c1, c2, &x);
    r.y = film_channel(ior, f0.y, c1, c2, &y);
    r.z = film_channel(ior, f0.z, c1, c2, &z);
    return r;
}
#endif

#endif
