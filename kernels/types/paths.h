/* Photons, recorded paths and counted work. Part of types.h. */
#ifndef TRIAD_TYPES_PATHS_H
#define TRIAD_TYPES_PATHS_H

#include "types/geometry.h"
#include "types/lights.h"

TRIAD_TYPES_BEGIN

/* ---- Photons (kernels/photon) ---- */

/* A sphere around geometry that reflects or refracts without blur: photons are aimed at these. */
typedef struct Caster {
    float centre[3]; /* rebased */
    float radius;
} Caster;
TRIAD_SIZE(Caster, 16);

#define PHOTON_CASTERS 32 /* at most */
#define MAP_CHUNK 256u    /* buckets of a map that one item sums up (photon/map.cl) */

/* A photon that landed, as it lies in a map. */
typedef struct Photon {
    float position[3]; /* rebased */
    float power[3]; /* flux over the cosine at which it came in; of one wavelength: per nm, without its filter
                     */
    uint direction; /* where it came from, the edges of its way, and what this was: photon_map.h */
    uint normal;    /* of the surface on the side it came from, and its wavelength */
} Photon;
TRIAD_SIZE(Photon, 32);

/* Photons of one pass (or of all), by the cell of a hash grid that they lie in: shading/photon_map.h. */
typedef struct PhotonMap {
    float radius;         /* of the sphere that is searched around a point */
    float cells_per_unit; /* 1 / side of a cell, which is wider than the sphere */
    uint bucket_mask;     /* buckets - 1: a power of two */
    float wavelengths;    /* nm: light of one wavelength is gathered from photons within this of it */
    float sharp_radius;   /* the same where the camera looks by mirrors and glass alone */
} PhotonMap;
TRIAD_SIZE(PhotonMap, 20);

/* What all photons of a picture share. Sample s of the picture comes with photons [s * count, (s + 1) *
 * count) of the sequence. */
typedef struct PhotonFrame {
    uint count;
    uint casters;          /* 0: photons start everywhere, aimed at nothing */
    uint scatter;          /* 1: every surface scatters them; 0: mirrors and glass alone do */
    float pixel_area;      /* of a pixel on the image plane at distance 1 (orthographic: in scene units) */
    CdfShape lights;       /* the tree that photons pick their light by */
    float scene_centre[3]; /* of a sphere around what is drawn: light from afar starts outside */
    float scene_radius;
} PhotonFrame;
TRIAD_SIZE(PhotonFrame, 72);

/* ---- Recorded paths (kernels/path/record.cl) ---- */

/* How a direction was sampled: bits. */
#define BSDF_NONE 0u
#define BSDF_DIFFUSE 1u
#define BSDF_GLOSSY 2u
#define BSDF_DELTA 4u
#define BSDF_TRANSMIT 8u /* together with one of the others: wi is beyond the surface */
#define BSDF_CLOUDED 16u /* together with BSDF_GLOSSY and that: where Lambert's lobe leads, too */

/* Why a path ends at a vertex. */
#define PATH_GOES_ON 0u
#define PATH_LEFT_SCENE 1u
#define PATH_UNLIT 2u    /* an unlit surface */
#define PATH_LONGEST 3u  /* Frame.max_depth */
#define PATH_ABSORBED 4u /* no direction was sampled, or one that shading normals do not allow */
#define PATH_ROULETTE 5u

/* One vertex after the camera. Radiance is what reaches the camera. primitive TRIAD_NONE: the path left the
 * scene, and `position` is its direction; material is TRIAD_NONE too. */
typedef struct PathVertex {
    float position[3]; /* rebased */
    uint primitive;
    uint instance;
    uint material;
    uint event;     /* BSDF_* bits of the direction that goes on */
    uint end;       /* PATH_* */
    float found[3]; /* emission that the path hit here, or the environment */
    uint light;     /* the Light that was sampled here and gave `direct`; TRIAD_NONE: none did */
    float direct[3];
    float throughput[3]; /* of what goes on, roulette included */
    uint edge;           /* that ends here; it falls where a path goes back and on with another wavelength */
    float wavelength;    /* that the path came with, in nm; 0: all of them */
} PathVertex;
TRIAD_SIZE(PathVertex, 80);

/* Vertices that are kept of a path; what later ones give is added to the last one's. */
#define PATH_VERTICES 64

typedef struct PathRecord {
    float value[4]; /* radiance and alpha, before the film's fixed point */
    uint vertices;  /* of the path, kept or not */
    uint rays;
    uint bin;
    uint half_index;
} PathRecord;
TRIAD_SIZE(PathRecord, 32);

/* ---- Counted work (kernels/path/count.cl) ---- */

/* Rays by what they are for. */
#define WORK_CAMERA 0
#define WORK_BOUNCE 1
#define WORK_SHADOW 2
#define WORK_KINDS 3

/* What the walks of rays did. Deepest: children that waited at most, summed over the rays, and of any. */
typedef struct RayWork {
    uint rays, nodes, blocks, triangles, deepest_sum, deepest;
} RayWork;
TRIAD_SIZE(RayWork, 24);

/* Of the samples of a pixel. */
typedef struct PixelWork {
    RayWork rays[WORK_KINDS];
} PixelWork;
TRIAD_SIZE(PixelWork, 72);

/* Of an edge of all paths, counted from the camera's: how long the lists of a wave would be. */
typedef struct EdgeWork {
    uint rays; /* that follow it */
    uint hits; /* of them, that end on a surface */
    uint shadow_rays;
} EdgeWork;
TRIAD_SIZE(EdgeWork, 12);
/* The last one stands for all later edges. */
#define WORK_EDGES 16

TRIAD_TYPES_END

#endif
