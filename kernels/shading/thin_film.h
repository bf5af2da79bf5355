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

/* Mean of cos(2 pi D / lambda), D in nm: at a wavelength, or at the channels of colours. */
#if TRIAD_HERO
TRIAD_FUNCTION float film_cosine(float wavelength, float difference) {
    return difference < FILM_MOST_DIFFERENCE ? math_cos_turns(difference / wavelength) : 0.0f;
}
#else
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

/* Amplitudes that the two sides of the film reflect, at one channel. */
typedef struct FilmSides {
    float s12, s23, p12, p23;
} FilmSides;
/* c1, c2: cosines in air and in the film. */
TRIAD_FUNCTION FilmSides film_sides(float ior, float f0, float c1, float c2) {
    const float root = sqrt(math_min(f0, 0.9998f)), base = (1.0f + root) / (1.0f - root);
    const float c3 = fresnel_refracted_cosine(c1, base);
    FilmSides a;
    a.s12 = (c1 - ior * c2) / (c1 + ior * c2), a.p12 = (ior * c1 - c2) / (ior * c1 + c2);
    a.s23 = (ior * c2 - base * c3) / (ior * c2 + base * c3);
    a.p23 = (base * c2 - ior * c3) / (base * c2 + ior * c3);
    return a;
}
TRIAD_FUNCTION float film_reflected(const FilmSides* a, float s, float p) {
    const float through = film_transmitted(a->s12, a->s23, s) + film_transmitted(a->p12, a->p23, p);
    return math_saturate(1.0f - 0.5f * through);
}
#if TRIAD_HERO
TRIAD_FUNCTION float film_wave(FilmSides a, float difference, float wavelength) {
    float s = 0.0f, p = 0.0f;
    for (uint m = FILM_ORDERS; m > 0u; --m) {
        const float cosine = film_cosine(wavelength, difference * (float)m);
        s = film_sum(a.s12, a.s23, cosine, s);
        p = film_sum(a.p12, a.p23, cosine, p);
    }
    return film_reflected(&a, s, p);
}
#else
/* cosines[m - 1]: the mean of cos(m phi). */
TRIAD_FUNCTION float film_channel(FilmSides a, const float cosines[FILM_ORDERS]) {
    float s = 0.0f, p = 0.0f;
    for (uint m = FILM_ORDERS; m > 0u; --m) {
        s = film_sum(a.s12, a.s23, cosines[m - 1u], s);
        p = film_sum(a.p12, a.p23, cosines[m - 1u], p);
    }
    return film_reflected(&a, s, p);
}
#endif

/* c: cosine in air; f0: of the base without the film. */
TRIAD_FUNCTION_PER_CALL Colour film_reflectance(const FilmInput* film, Colour f0, float c) {
    const float ior = film->ior, c1 = math_max(math_min(c, 1.0f), 1e-4f);
    const float c2 = fresnel_refracted_cosine(c1, ior);
    const float difference = 2.0f * ior * film->thickness * c2;
#if TRIAD_HERO
    const Vec4 w = film->wavelengths;
    return vec4_make(film_wave(film_sides(ior, f0.x, c1, c2), difference, w.x),
                     film_wave(film_sides(ior, f0.y, c1, c2), difference, w.y),
                     film_wave(film_sides(ior, f0.z, c1, c2), difference, w.z),
                     film_wave(film_sides(ior, f0.w, c1, c2), difference, w.w));
#else
    float x[FILM_ORDERS], y[FILM_ORDERS], z[FILM_ORDERS];
    for (uint m = 0u; m < FILM_ORDERS; ++m) {
        const Vec3 cosines = film_cosines(film, difference * (float)(m + 1u));
        x[m] = cosines.x, y[m] = cosines.y, z[m] = cosines.z;
    }
    return vec3_make(film_channel(film_sides(ior, f0.x, c1, c2), x),
                     film_channel(film_sides(ior, f0.y, c1, c2), y),
                     film_channel(film_sides(ior, f0.z, c1, c2), z));
#endif
}
#endif

#endif
