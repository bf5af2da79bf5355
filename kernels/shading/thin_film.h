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

/* Mean of cos(2 pi D / lambda), D in nm, at the colours' channels or wavelengths. */
TRIAD_FUNCTION Colour film_cosine(const FilmInput* film, float difference) {
#if TRIAD_HERO
    const Vec4 w = film->wavelengths;
    if (!(difference < FILM_MOST_DIFFERENCE)) return colour_splat(0.0f);
    return vec4_make(math_cos_turns(difference / w.x), math_cos_turns(difference / w.y),
                     math_cos_turns(difference / w.z), math_cos_turns(difference / w.w));
#else
    const float x = difference * (1.0f / FILM_STEP);
    if (!(x < (float)(FILM_ROWS - 1))) return colour_splat(0.0f);
    const uint i = (uint)x;
    global const float* row = film->responses + 3u * i;
    return vec3_mix(vec3_load(row, 0u), vec3_load(row, 1u), x - (float)i);
#endif
}

/* One polarisation of one channel: r12 r23, its power, the sum so far and what that is scaled by to be 1 - R.
 */
typedef struct FilmPart {
    float x, power, sum, scale;
} FilmPart;
TRIAD_FUNCTION FilmPart film_part(float r12, float r23) {
    FilmPart part;
    part.x = r12 * r23;
    part.power = 1.0f;
    part.sum = 0.5f;
    part.scale = 2.0f * (1.0f - r12 * r12) * (1.0f - r23 * r23) / math_max(1.0f - part.x * part.x, 1e-6f);
    return part;
}
TRIAD_FUNCTION void film_part_add(FilmPart* part, float cosine) {
    part->power *= -part->x;
    part->sum = fma(part->power, cosine, part->sum);
}

typedef struct FilmChannel {
    FilmPart s, p;
} FilmChannel;
/* c1, c2: cosines in air and in the film. */
TRIAD_FUNCTION FilmChannel film_channel(float ior, float f0, float c1, float c2) {
    const float root = sqrt(math_min(f0, 0.9998f)), base = (1.0f + root) / (1.0f - root);
    const float c3 = fresnel_refracted_cosine(c1, base);
    FilmChannel channel;
    channel.s = film_part((c1 - ior * c2) / (c1 + ior * c2), (ior * c2 - base * c3) / (ior * c2 + base * c3));
    channel.p = film_part((ior * c1 - c2) / (ior * c1 + c2), (base * c2 - ior * c3) / (base * c2 + ior * c3));
    return channel;
}
/* The next m; cosine: the mean of cos(m phi). */
TRIAD_FUNCTION void film_channel_add(FilmChannel* channel, float cosine) {
    film_part_add(&channel->s, cosine);
    film_part_add(&channel->p, cosine);
}
TRIAD_FUNCTION float film_channel_reflectance(const FilmChannel* channel) {
    const float through = fma(channel->s.sum, channel->s.scale, channel->p.sum * channel->p.scale);
    return math_saturate(1.0f - 0.5f * through);
}

/* c: cosine in air; f0: of the base without the film. */
TRIAD_FUNCTION_PER_CALL Colour film_reflectance(const FilmInput* film, Colour f0, float c) {
    const float c1 = math_max(math_min(c, 1.0f), 1e-4f);
    const float c2 = fresnel_refracted_cosine(c1, film->ior);
    const float difference = 2.0f * film->ior * film->thickness * c2;
    FilmChannel x = film_channel(film->ior, f0.x, c1, c2), y = film_channel(film->ior, f0.y, c1, c2),
                z = film_channel(film->ior, f0.z, c1, c2);
#if TRIAD_HERO
    FilmChannel w = film_channel(film->ior, f0.w, c1, c2);
#endif
    for (uint m = 1u; m <= FILM_ORDERS; ++m) {
        const Colour cosine = film_cosine(film, difference * (float)m);
        film_channel_add(&x, cosine.x);
        film_channel_add(&y, cosine.y);
        film_channel_add(&z, cosine.z);
#if TRIAD_HERO
        film_channel_add(&w, cosine.w);
#endif
    }
    Colour r;
    r.x = film_channel_reflectance(&x);
    r.y = film_channel_reflectance(&y);
    r.z = film_channel_reflectance(&z);
#if TRIAD_HERO
    r.w = film_channel_reflectance(&w);
#endif
    return r;
}
#endif

#endif
