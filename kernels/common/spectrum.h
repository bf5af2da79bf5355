/* Light of one wavelength: which one a path or a pass of photons carries, what it adds to the picture, and
 * how bodies refract it. Scheme and measurements: docs/spectral.md. */
#ifndef TRIAD_COMMON_SPECTRUM_H
#define TRIAD_COMMON_SPECTRUM_H

#include "common/vector.h"

/* Where between the rows of a table a wavelength (in nm) is: the row below, and the share of the next. */
TRIAD_FUNCTION uint spectrum_row(float nanometres, float* share) {
    const float x =
        math_clamp((nanometres - SPECTRUM_FIRST) * (1.0f / SPECTRUM_STEP), 0.0f, (float)(SPECTRUM_ROWS - 1));
    const uint row = math_min_uint((uint)x, SPECTRUM_ROWS - 2u);
    *share = x - (float)row;
    return row;
}

/* The linear Rec.709 colour that light of a wavelength adds to white light, per nanometre; signed. */
TRIAD_FUNCTION Vec3 spectrum_filter(global const Spectrum* s, float nanometres) {
    float t;
    const uint row = spectrum_row(nanometres, &t);
    const Vec4 a = vec4_load(&s->filter[0][0], row), b = vec4_load(&s->filter[0][0], row + 1u);
    return vec4_xyz(vec4_mix(a, b, t));
}

/* Draws a wavelength in nm from u in [0, 1). *nm: 1 / its density. */
TRIAD_FUNCTION float spectrum_draw(global const Spectrum* s, float u, float* nm) {
    const float x = u * (float)(WAVELENGTH_NODES - 1);
    const uint i = math_min_uint((uint)x, WAVELENGTH_NODES - 2u);
    const float lo = s->wavelength[i], width = s->wavelength[i + 1u] - lo;
    *nm = width * (float)(WAVELENGTH_NODES - 1);
    return fma(x - (float)i, width, lo);
}

/* Draws a wavelength too. *filter: spectrum_filter over the density, whose mean over u is (1, 1, 1): a path
 * of throughput T that goes on with this wavelength alone brings T * filter. Where two of one wavelength each
 * meet (a path and a photon that it gathers), the filter counts once. */
TRIAD_FUNCTION float spectrum_sample(global const Spectrum* s, float u, Vec3* filter) {
    float nm;
    const float nanometres = spectrum_draw(s, u, &nm);
    *filter = vec3_scale(spectrum_filter(s, nanometres), nm);
    return nanometres;
}

/* Of a wavelength in light of spectrum `which`, over D65 of the same luminance. */
TRIAD_FUNCTION float spectrum_of_light(global const Spectrum* s, uint which, float nanometres) {
#if TRIAD_LIGHT_SPECTRA
    if (which == 0u) return 1.0f;
    const float x = math_clamp(nanometres - SPECTRUM_FIRST, 0.0f, (float)(LIGHT_SPECTRUM_ROWS - 1));
    const uint row = math_min_uint((uint)x, LIGHT_SPECTRUM_ROWS - 2u);
    const float a = s[which].light[row], b = s[which].light[row + 1u];
    return fma(x - (float)row, b - a, a);
#else
    (void)s, (void)which, (void)nanometres;
    return 1.0f;
#endif
}

/* Light of spectrum `which`, all wavelengths together. */
TRIAD_FUNCTION Vec3 spectrum_colour_of_light(global const Spectrum* s, uint which) {
#if TRIAD_LIGHT_SPECTRA
    if (which != 0u) return VEC3_OF(s[which].colour);
#else
    (void)s, (void)which;
#endif
    return vec3_splat(1.0f);
}

/* spectrum_draw() by the spectrum of the light that a photon comes from. *carried: the light's share at that
 * wavelength over the density, in nm. The mean of carried * spectrum_filter is the light's colour. */
TRIAD_FUNCTION float spectrum_draw_light(global const Spectrum* s, uint which, float u, float* carried) {
#if TRIAD_LIGHT_SPECTRA
    const float nanometres = spectrum_draw(s + which, u, carried);
    *carried *= spectrum_of_light(s, which, nanometres);
    return nanometres;
#else
    (void)which;
    return spectrum_draw(s, u, carried);
#endif
}

/* What the primaries of Rec.709 reflect of a wavelength; white reflects all of it. */
TRIAD_FUNCTION Vec3 spectrum_basis(global const Spectrum* s, float nanometres) {
    float t;
    const uint row = spectrum_row(nanometres, &t);
    const Vec4 a = vec4_load(&s->basis[0][0], row), b = vec4_load(&s->basis[0][0], row + 1u);
    return vec4_xyz(vec4_mix(a, b, t));
}

/* The index of refraction of a table of `indices`: Hermite's cubic between its rows, exact to rounding. */
TRIAD_FUNCTION float spectrum_index(global const float* indices, uint table, float nanometres) {
    float t;
    const uint row = spectrum_row(nanometres, &t);
    const Vec4 p = VEC4_OF(indices + 2u * (table * SPECTRUM_ROWS + row)); /* n, slope, n, slope */
    const float rise = p.z - p.x;
    const float cubic = p.y + p.w - 2.0f * rise, square = rise - p.y - cubic;
    return fma(t, fma(t, fma(t, cubic, square), p.y), p.x);
}

#endif
