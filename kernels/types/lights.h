/* Wavelengths, lights and the environment. Part of types.h. */
#ifndef TRIAD_TYPES_LIGHTS_H
#define TRIAD_TYPES_LIGHTS_H

#include "types/border.h"

TRIAD_TYPES_BEGIN

/* ---- Wavelengths (kernels/common/spectrum.h) ---- */

/* Tables over the wavelength: rows of 5 nm, straight lines between. */
#define SPECTRUM_FIRST 380.0f
#define SPECTRUM_STEP 5.0f
#define SPECTRUM_ROWS 81
#define WAVELENGTH_NODES 513
/* Tables of lights' spectra: rows of 1 nm from SPECTRUM_FIRST on, so that lines are narrow. */
#define LIGHT_SPECTRUM_ROWS 401

/* The first of a scene is what paths draw from; after it comes one for each spectrum that lights have of
 * their own, which photons of these lights draw from. */
typedef struct Spectrum {
    float wavelength[WAVELENGTH_NODES]; /* nm: inverse of the distribution that wavelengths are drawn from */
    float filter[SPECTRUM_ROWS][4];     /* linear Rec.709 per nm, signed; the integral is (1, 1, 1) */
    float basis[SPECTRUM_ROWS][4];      /* what the primaries of Rec.709 reflect; the sum is 1 */
    float light[LIGHT_SPECTRUM_ROWS];   /* the light's spectrum over D65, at equal luminance */
    float colour[3]; /* of the light, all wavelengths together: linear Rec.709, signed, of luminance 1 */
} Spectrum;
TRIAD_SIZE(Spectrum, 6260);

/* ---- Lights ---- */

#define LIGHT_TRIANGLE 0u
#define LIGHT_POINT 1u
#define LIGHT_SPOT 2u
#define LIGHT_DIRECTIONAL 3u
#define LIGHT_ENVIRONMENT 4u

#define LIGHT_PHOTONS \
    0x100u /* photons bring what mirrors and glass throw of this light onto other surfaces */
#define LIGHT_SPECTRUM_SHIFT 16 /* flags above: which Spectrum; 0: D65, or a colour that says it all */

#define LIGHT_UNPICKED 3e38f

/* colour: radiance factor of a triangle (texture not included), intensity W/sr of point and spot, irradiance
 * of directional. Emissive geometry is always flattened, so positions are in rebased world space. */
typedef struct Light {
    uint type;
    uint primitive;    /* TRIANGLE: its Triangle */
    float pick;        /* probability that light sampling picks this light */
    float area;        /* TRIANGLE */
    float position[3]; /* corner 0, or the position */
    float range;       /* punctual; 0 = no limit. TRIANGLE: where a corner is nearer than this, points are
                          drawn by solid angle */
    float edge1[3];    /* TRIANGLE: corner 1 - corner 0 */
    float cone_scale;  /* SPOT: attenuation = clamp(cos * scale + offset, 0, 1)^2 */
    float edge2[3];    /* TRIANGLE: corner 2 - corner 0 */
    float cone_offset;
    float axis[3]; /* unit; TRIANGLE: normal of the front; SPOT, DIRECTIONAL: where the light goes */
    uint flags;    /* MATERIAL_DOUBLE_SIDED of the triangle's material; LIGHT_PHOTONS; LIGHT_SPECTRUM_SHIFT */
    float colour[3];
    float inverse_pick; /* 1 / pick, or LIGHT_UNPICKED */
} Light;
TRIAD_SIZE(Light, 96);

/* A node of the tree over point, spot and triangle lights: its eight children, side by side. The lights of a
 * child lie in its sphere; their axes lie within an angle of the child's, and the light of each of them
 * within another of its own axis. */
#define LIGHT_NODE_CHILDREN 8
#define LIGHT_NODE_LEAF 0x80000000u
typedef struct LightNode {
    float centre[3][LIGHT_NODE_CHILDREN], radius[LIGHT_NODE_CHILDREN];
    float axis[3][LIGHT_NODE_CHILDREN];
    float spread_cosine[LIGHT_NODE_CHILDREN], spread_sine[LIGHT_NODE_CHILDREN]; /* of the first angle */
    float least_cosine[LIGHT_NODE_CHILDREN];                                    /* of the second */
    float power[LIGHT_NODE_CHILDREN];                                           /* 0: no child */
    uint content[LIGHT_NODE_CHILDREN]; /* a LightNode, or LIGHT_NODE_LEAF | a Light */
} LightNode;
TRIAD_SIZE(LightNode, 384);

/* The shape of a tree over n intervals of [0, 2^32 - 1), searched eight bounds at a time. Level k holds every
 * 8^(levels - 1 - k)-th bound, in groups of eight, from first[k] on; the last level holds them all, and the
 * final bound 2^32 - 1 after them. What is over is filled with 2^32 - 1. */
#define CDF_LEVELS 8
typedef struct CdfShape {
    uint levels;
    uint size; /* of one tree, in uints: a multiple of 8 */
    uint first[CDF_LEVELS];
} CdfShape;
TRIAD_SIZE(CdfShape, 40);

/* The columns of the environment's rows: 16-bit trees of 32 children, level by level from the top, the rows
 * of a level one after the other, so that the upper levels of all rows stay in the cache. An entry is the
 * last of the 65536 equal shares of its row that belongs to it or to what comes before it; every column has
 * one share at least. */
#define COLUMNS_FANOUT 32u
#define COLUMNS_LEVELS 3 /* up to 32768 columns */
typedef struct ColumnsShape {
    uint levels;
    uint first[COLUMNS_LEVELS];  /* of a level, in ushorts */
    uint stride[COLUMNS_LEVELS]; /* of a row in a level: a multiple of COLUMNS_FANOUT */
    uint size;                   /* of all, in ushorts */
} ColumnsShape;
TRIAD_SIZE(ColumnsShape, 32);

/* After the columns, in the same array: where a surface may face, as far as light sampling of the environment
 * tells (kernels/shading/facing.h): the cells of an octahedron, across and down; and the patches of the map,
 * rows and columns of them. A facing has the last of the 65536 shares of every row of patches, and then of
 * every patch of each row. */
#define FACINGS 16
#define PATCH_BITS 4u
#define PATCHES 16u
#define FACING_SHARES (PATCHES + PATCHES * PATCHES)

/* A texel of the environment and the solid-angle density of drawing a direction in it. */
#define ENVIRONMENT_FLOAT 0u /* float[4]: R, G, B, density */
#define ENVIRONMENT_RGBE                                                              \
    1u /* uint[2]: 8-bit R, G, B from the low byte, times 2^(top byte - 127); density \
        */

/* The environment: radiance = strength * texel, bilinear. World y is up before the rotation about it.
 * u = .5 + atan2(z, x) / 2 pi, v = acos(y) / pi from the top. width 0: none, radiance is `colour` everywhere.
 */
typedef struct Environment {
    uint width, height;
    uint light; /* its Light, or TRIAD_NONE when it emits nothing */
    float strength;
    float rotate_cos, rotate_sin; /* map direction = (c x + s z, y, -s x + c z) of world direction */
    CdfShape rows;
    ColumnsShape columns;
    float colour[4]; /* used when width is 0 */
    uint format;
    uint photons; /* 1: it is a light of photons (LIGHT_PHOTONS) */
} Environment;
TRIAD_SIZE(Environment, 120);

TRIAD_TYPES_END

#endif
