/* The camera, the film, and the work of a launch. Part of types.h. */
#ifndef TRIAD_TYPES_PICTURE_H
#define TRIAD_TYPES_PICTURE_H

#include "types/geometry.h"
#include "types/lights.h"

TRIAD_TYPES_BEGIN

/* ---- Camera and film ---- */

#define CAMERA_PERSPECTIVE 0u
#define CAMERA_ORTHOGRAPHIC 1u

/* right, up, forward are unit and orthogonal. Image plane: x right, y down, in pixels of the full picture.
 * The ray of film position (x, y) passes forward + right * (x / width * 2 - 1) * extent[0] - up * (y / height
 * * 2 - 1) * extent[1]. */
typedef struct Camera {
    float origin[3];
    float lens_radius;
    float right[3];
    float focus_distance;
    float up[3];
    uint projection;
    float forward[3];
    float pixel_area; /* of a pixel on the image plane at distance 1 (orthographic: in scene units) */
    float extent[2];  /* half width and half height of the image plane at distance 1 (orthographic: in scene
                         units) */
    float pixels[2];  /* width and height of the full picture */
} Camera;
TRIAD_SIZE(Camera, 80);

#define SAMPLER_SOBOL_BLOCKS 9u /* of random numbers, from Sobol's sequence; those beyond are hashed */

/* Where in its bin a camera ray starts. */
#define RAY_START_JITTER 0u /* anywhere, with equal density */
#define RAY_START_CENTRE 1u
#define RAY_START_FILTER 2u /* where a pixel filter says, which may lie outside: shading/ray_filter.h */

/* The shape of the tables that rays start by, one for every bin of every pixel of a cell (RAY_START_FILTER):
 * all of width x height taps, which are 1 / taps_x by 1 / taps_y pixels large. */
typedef struct RayFilterShape {
    uint cell[2]; /* pixels */
    uint taps[2]; /* per pixel */
    uint width, height;
    uint table; /* floats of a table */
} RayFilterShape;
TRIAD_SIZE(RayFilterShape, 28);

/* Where paths gather photons, and which: Frame.photon_map */
#define PHOTON_MAP_PROGRESSIVE \
    1u /* at every vertex but the first, light that came by mirrors and glass alone */
#define PHOTON_MAP_FINAL_GATHER 2u /* such light at the first surface that blurs, all light at the second */
#define PHOTON_MAP_VISUALISED 3u   /* all light but the direct at the first surface that blurs */

/* Everything of one picture that does not change between launches. */
typedef struct Frame {
    Camera camera;
    Environment environment;
    uint crop[4]; /* x, y, width, height in pixels of the full picture; the film covers the crop only */
    uint bins[2]; /* bins per pixel in x and y */
    uint seed;
    uint max_depth;   /* edges; 0 = no limit */
    uint transparent; /* 1: the camera does not see the environment; alpha is 0 there */
    uint light_count;
    float quanta;                  /* fixed-point units per unit of radiance: a power of two */
    uint root[BVH_FORMATS];        /* node of the world's tree, by TRIAD_BVH4 */
    CdfShape lights;               /* the tree that lights are picked by */
    uint light_first, light_range; /* shares of 2^31 by which it picks a light of the tree of LightNodes */
    float roulette;                /* 1 / throughput below which roulette kills, in proportion */
    uint first_block; /* of random numbers: 0, or SAMPLER_SOBOL_BLOCKS to have none of Sobol's sequence */
    uint wavelength_from_camera; /* 1: every path has a wavelength from its start on */
    uint ray_start;              /* RAY_START_* */
    RayFilterShape ray_filter;
    uint photons;    /* 1: light of LIGHT_PHOTONS is left to photons where they bring it */
    uint photon_map; /* PHOTON_MAP_*, or 0: paths gather no photons */
} Frame;
TRIAD_SIZE(Frame, 352);

/* Pixels of a tile that one item of path/mega.cl has, where camera rays are walked in packets. */
#define MEGA_BLOCK 8

/* What one tile of 8 x 8 pixels of the film is to be given: which samples, counted from the launch's first.
 * The pixels of a tile are two sets, like the squares of a chessboard: set (x ^ y) & 1. Adaptive sampling
 * decides for one set by what the other has found, so that no pixel's samples decide how many it gets
 * (host/render/adaptive.h). */
#define FILM_TILE 8
#define FILM_TILE_PIXELS 64
typedef struct TileWork {
    uint tile; /* row-major over the crop */
    uint first_sample[2];
    uint sample_count[2];
    uint unused[3];
} TileWork;
TRIAD_SIZE(TileWork, 32);

/* Pools of paths (path/wave.h): slots of one, words from one of its planes to the next (no power of two, or
 * they would share few lines of a cache), and how many planes paths, hits and lights have at most. */
#define POOL_SLOTS 256
#define POOL_PLANE 272
#define POOL_PATH_PLANES 83
#define POOL_HIT_PLANES 6
#define POOL_LIGHT_PLANES 20
/* Words of a slot, one after the other: means of a film for each of four wavelengths (shading/bsdf_input.h).
 */
#define POOL_FILM_WORDS 32

/* Film channels: R, G, B, alpha; sums are int64 fixed point, so that order does not matter. */
#define FILM_CHANNELS 4
#define FILM_MOST_BINS 16 /* of a pixel along an axis */

/* Counters, as pairs of uints (low, high): what happened, over all launches. Index = 2 * COUNTER_x. */
#define COUNTER_RAYS 0       /* closest-hit and occlusion rays */
#define COUNTER_NOT_FINITE 1 /* samples dropped for a NaN or an infinity */
#define COUNTER_SATURATED 2  /* samples that did not fit the fixed point */
#define COUNTER_TRUNCATED 3  /* paths cut by max_depth */
#define COUNTER_CUT_ENERGY 4 /* sum of their throughput (luminance), in units of 1 / CUT_ENERGY_ONE */
#define COUNTERS 5
#define CUT_ENERGY_ONE 65536.0f

TRIAD_TYPES_END

#endif
