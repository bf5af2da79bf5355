/* The colours of a path: RGB, with one wavelength from some vertex on, or (TRIAD_HERO) four wavelengths. What
 * surfaces and lights say in RGB is turned into them here, and what a path found back into RGB for the film.
 */
#ifndef TRIAD_PATH_COLOUR_H
#define TRIAD_PATH_COLOUR_H

#include "common/colour.h"
#include "common/random.h"
#include "common/spectrum.h"
#include "shading/vertex.h"

#define PATH_WAVELENGTH_SET 2u /* of random numbers: the samples of a pixel share the spectrum out evenly */
/* That a path is followed with from its first dispersive surface on. Three have a quarter of the error of one
 * for at most twice the time; four are no better (docs/spectral.md). */
#define PATH_WAVELENGTHS 3u

#if TRIAD_HERO

/* Wilkie et al. 2014, "Hero Wavelength Spectral Sampling": the first wavelength decides where the path goes,
 * the others are a quarter of the distribution apart. What is found is weighed over all four as if each had
 * been the first (balance heuristic). `throughput` of the path is f / (mean over k of share_k p_k). */
typedef struct PathColour {
    Vec4 wavelengths; /* nm */
    Vec4 share; /* density of the path so far were that wavelength the first, in proportion; the sum is 4 */
    Vec4 basis[3];  /* reflectance of the primaries of Rec.709 */
    Vec4 filter[3]; /* R, G, B that each wavelength adds, over its density, divided by 4 */
} PathColour;

TRIAD_FUNCTION PathColour path_colour_start(const Scene* scene, const Sampler* sampler) {
    const float u = sampler_2d(sampler, PATH_WAVELENGTH_SET).x;
    float nanometres[4], basis[3][4], filter[3][4];
    for (uint i = 0u; i < 4u; ++i) {
        float v = fma(0.25f, (float)i, u);
        v -= v >= 1.0f ? 1.0f : 0.0f;
        Vec3 f;
        nanometres[i] = spectrum_sample(scene->spectrum, v, &f);
        const Vec3 b = spectrum_basis(scene->spectrum, nanometres[i]);
        basis[0][i] = b.x, basis[1][i] = b.y, basis[2][i] = b.z;
        filter[0][i] = 0.25f * f.x, filter[1][i] = 0.25f * f.y, filter[2][i] = 0.25f * f.z;
    }
    PathColour c;
    c.wavelengths = VEC4_OF(nanometres);
    c.share = vec4_splat(1.0f);
    for (uint k = 0u; k < 3u; ++k) c.basis[k] = VEC4_OF(basis[k]), c.filter[k] = VEC4_OF(filter[k]);
    return c;
}

TRIAD_FUNCTION Vec4 path_wavelengths(const PathColour* c) { return c->wavelengths; }
TRIAD_FUNCTION float path_wavelength(const PathColour* c) { return c->wavelengths.x; }

/* Of a reflectance, an absorption, or light that is D65 when white. */
TRIAD_FUNCTION Colour path_colour(const PathColour* c, Vec3 rgb) {
    const Colour blue = colour_scale(c->basis[2], rgb.z);
    return colour_fma_scale(rgb.x, c->basis[0], colour_fma_scale(rgb.y, c->basis[1], blue));
}

TRIAD_FUNCTION Vec3 path_rgb(const PathColour* c, Colour found) {
    const Vec4 r = vec4_mul(c->filter[0], found), g = vec4_mul(c->filter[1], found),
               b = vec4_mul(c->filter[2], found);
    return vec3_make(r.x + r.y + r.z + r.w, g.x + g.y + g.z + g.w, b.x + b.y + b.z + b.w);
}
#define path_found path_rgb
TRIAD_FUNCTION float path_share(const PathColour* c) {
    (void)c;
    return 1.0f;
}

#if TRIAD_DISPERSION
TRIAD_FUNCTION int path_has_others(const PathColour* c) { return c->share.y > 0.0f; }

/* A mirror-smooth surface sends every wavelength elsewhere: the first goes on alone, for all four. */
TRIAD_FUNCTION void path_end_others(PathColour* c, Colour* throughput) {
    const float scale = 4.0f / c->share.x;
    *throughput = vec4_make(throughput->x * scale, 0.0f, 0.0f, 0.0f);
    c->share = vec4_make(4.0f, 0.0f, 0.0f, 0.0f);
}

/* The density of what was drawn, over all choices of the first wavelength. */
TRIAD_FUNCTION float path_mean_density(const PathColour* c, Vec4 densities) {
    return colour_average(vec4_mul(c->share, densities));
}
#endif

#else

typedef struct PathColour {
    float wavelength; /* nm; 0: all of them together */
#if TRIAD_DISPERSION
    /* what the path finds with one wavelength counts by `filter`; what it found before */
    Vec3 filter, before;
    float share; /* of the path that goes on with this wavelength */
#endif
} PathColour;

#if TRIAD_DISPERSION
/* Goes on with another wavelength: one of the whole spectrum. */
TRIAD_FUNCTION void path_take_wavelength(PathColour* c, const Scene* scene, float u, float share,
                                         Vec3* radiance) {
    c->before = vec3_fma(c->filter, *radiance, c->before);
    *radiance = vec3_splat(0.0f);
    c->wavelength = spectrum_sample(scene->spectrum, u, &c->filter);
    c->filter = vec3_scale(c->filter, share);
    c->share = share;
}
/* The branch-th of PATH_WAVELENGTHS, which share the spectrum out evenly. */
TRIAD_FUNCTION void path_draw_wavelength(PathColour* c, const Scene* scene, const Sampler* sampler,
                                         uint branch, Vec3* radiance) {
    const float share = 1.0f / (float)PATH_WAVELENGTHS,
                u = sampler_2d(sampler, PATH_WAVELENGTH_SET).x + (float)branch;
    path_take_wavelength(c, scene, math_min(u * share, 0.99999994f), share, radiance);
}
#endif

/* All wavelengths together. */
TRIAD_FUNCTION PathColour path_colour_white(void) {
    PathColour c;
    c.wavelength = 0.0f;
#if TRIAD_DISPERSION
    c.filter = vec3_splat(1.0f);
    c.before = vec3_splat(0.0f);
    c.share = 1.0f;
#endif
    return c;
}

TRIAD_FUNCTION PathColour path_colour_start(const Scene* scene, const Sampler* sampler) {
    PathColour c = path_colour_white();
#if TRIAD_DISPERSION
    Vec3 nothing = vec3_splat(0.0f);
    if (scene->frame->wavelength_from_camera)
        path_take_wavelength(&c, scene, sampler_2d(sampler, PATH_WAVELENGTH_SET).x, 1.0f, &nothing);
#else
    (void)scene, (void)sampler;
#endif
    return c;
}

TRIAD_FUNCTION float path_wavelengths(const PathColour* c) { return c->wavelength; }
TRIAD_FUNCTION float path_wavelength(const PathColour* c) { return c->wavelength; }
TRIAD_FUNCTION Colour path_colour(const PathColour* c, Vec3 rgb) {
    (void)c;
    return rgb;
}

/* How much of a path goes on with the present wavelength. */
TRIAD_FUNCTION float path_share(const PathColour* c) {
#if TRIAD_DISPERSION
    return c->share;
#else
    (void)c;
    return 1.0f;
#endif
}

/* What a contribution adds to the film; path_rgb: all that was found, the last of it since the wavelength was
 * drawn. */
#if TRIAD_DISPERSION
TRIAD_FUNCTION Vec3 path_found(const PathColour* c, Vec3 found) { return vec3_mul(c->filter, found); }
TRIAD_FUNCTION Vec3 path_rgb(const PathColour* c, Vec3 radiance) {
    return vec3_fma(c->filter, radiance, c->before);
}
#else
TRIAD_FUNCTION Vec3 path_found(const PathColour* c, Vec3 found) { return path_colour(c, found); }
TRIAD_FUNCTION Vec3 path_rgb(const PathColour* c, Vec3 radiance) { return path_colour(c, radiance); }
#endif

#endif

#if TRIAD_LIGHT_SPECTRA
/* What a spectrum of light has of the path's wavelengths. */
#if TRIAD_HERO
TRIAD_FUNCTION_ONCE Colour path_spectrum(global const Spectrum* spectra, uint which, Vec4 at) {
    return vec4_make(spectrum_of_light(spectra, which, at.x), spectrum_of_light(spectra, which, at.y),
                     spectrum_of_light(spectra, which, at.z), spectrum_of_light(spectra, which, at.w));
}
#else
TRIAD_FUNCTION Colour path_spectrum(global const Spectrum* spectra, uint which, float wavelength) {
    return wavelength > 0.0f ? vec3_splat(spectrum_of_light(spectra, which, wavelength))
                             : spectrum_colour_of_light(spectra, which);
}
#endif
#endif

/* The light of a Light with these flags, whose colour is `rgb`. */
TRIAD_FUNCTION Colour path_light(const Scene* scene, const PathColour* c, uint flags, Vec3 rgb) {
    const Colour colour = path_colour(c, rgb);
#if TRIAD_LIGHT_SPECTRA
    const uint which = flags >> LIGHT_SPECTRUM_SHIFT;
    if (which != 0u) return colour_mul(colour, path_spectrum(scene->spectrum, which, path_wavelengths(c)));
#else
    (void)scene, (void)flags;
#endif
    return colour;
}

#if TRIAD_TRANSMISSION
/* What a body lets through over a distance. */
TRIAD_FUNCTION Colour path_transmittance(const PathColour* c, global const Material* body, float distance) {
#if TRIAD_HERO
    const Colour depth = colour_scale(path_colour(c, VEC3_OF(body->absorption)), -distance);
    return vec4_make(math_exp(depth.x), math_exp(depth.y), math_exp(depth.z), math_exp(depth.w));
#else
    (void)c;
    return vertex_transmittance(body, distance);
#endif
}
#endif

#endif
