/* A glTF material at a point, as its BSDF is made from it. */
#ifndef TRIAD_SHADING_BSDF_INPUT_H
#define TRIAD_SHADING_BSDF_INPUT_H

#include "common/colour.h"

/* Share of the transmitting part that is sampled even where it looks black from wo. */
#define BSDF_MIN_TRANSMITTER 0.1f

/* Whatever transmits also reflects. */
#define BSDF_TRANSMISSION (TRIAD_SPECULAR && TRIAD_TRANSMISSION)
/* Microfacets that are longer one way than the other; a thin film over them. */
#define BSDF_STRETCHED (TRIAD_SPECULAR && TRIAD_ANISOTROPY)
#define BSDF_FILM (TRIAD_SPECULAR && TRIAD_IRIDESCENCE)
/* Something lies over the base. */
#define BSDF_LAYERED (TRIAD_CLEARCOAT || TRIAD_SHEEN)

#if BSDF_FILM
/* A thin film between air and the base (shading/thin_film.h). */
typedef struct FilmInput {
    float ior;       /* 1 to 1e6 */
    float thickness; /* nm */
#if TRIAD_HERO
    Vec4 wavelengths; /* nm */
#else
    global const float* responses; /* Scene.film_responses */
#endif
} FilmInput;
/* Of a film on a rough base, seen from one wo (shading/base_film.h). */
typedef struct FilmMeans {
    Colour mean; /* of its reflectance, over what the base reflects */
    Colour rise; /* what a film of share 1 adds to the albedo of a body */
} FilmMeans;
#endif

typedef struct BsdfInput {
    Colour base_colour;
    float metallic, roughness, ior, specular;
    Colour specular_colour;
    float transmission;
    uint solid;  /* refracts: a closed body */
    uint inside; /* wo is on the inner side of a solid body */
#if TRIAD_CLEARCOAT
    float coat, coat_roughness;
    Vec3 coat_normal; /* unit, in the local frame, on wo's side */
#endif
#if TRIAD_SHEEN
    Colour sheen;
    float sheen_roughness;
#endif
#if BSDF_STRETCHED
    float anisotropy; /* strength: along x */
#endif
#if BSDF_FILM
    float film; /* share of the surface that it covers */
    FilmInput film_input;
    uint has_film_means;            /* 0: they are to be found */
    global const float* film_means; /* FilmMeans */
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    float through; /* share of the Lambert base that leaves beyond the surface */
    Colour through_colour;
#endif
} BsdfInput;

/* A rough dielectric of index 1.5 that is nothing else. */
TRIAD_FUNCTION BsdfInput bsdf_input_plain(Colour base_colour) {
    BsdfInput in;
    in.base_colour = base_colour;
    in.specular_colour = colour_splat(1.0f);
    in.metallic = in.transmission = 0.0f;
    in.roughness = in.specular = 1.0f;
    in.ior = 1.5f;
    in.solid = in.inside = 0u;
#if TRIAD_CLEARCOAT
    in.coat = 0.0f;
#endif
#if TRIAD_SHEEN
    in.sheen = colour_splat(0.0f);
#endif
#if BSDF_STRETCHED
    in.anisotropy = 0.0f;
#endif
#if BSDF_FILM
    in.film = 0.0f;
    in.has_film_means = 0u;
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    in.through = 0.0f;
#endif
    return in;
}

typedef struct BsdfSample {
    Vec3 wi;
    Colour weight; /* f |cos| / pdf */
    float pdf;     /* solid angle, over all lobes; 0 for a delta lobe */
    uint event;    /* BSDF_* bits; BSDF_NONE: absorbed */
} BsdfSample;

/* Of a drawn wi with its pdf, where f is f |cos|. */
TRIAD_FUNCTION void bsdf_weigh(BsdfSample* s, Colour f) {
    if (s->pdf > 0.0f)
        s->weight = colour_div(f, colour_splat(s->pdf));
    else
        s->event = BSDF_NONE;
}

#endif
