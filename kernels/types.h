/* The border: every struct and constant that host and device share. C++ and OpenCL C read this same file.
 *
 * Rules: 4-byte scalars and arrays of them only (no vector types, pointers, enums, bools), so that every
 * compiler lays them out alike; sizes are asserted here on both sides, offsets by the device test `layout`.
 * Units: lengths in scene units, rebased to the render origin unless said; radiance in W/(m^2 sr) per channel
 * of linear Rec.709 (for glTF: nits); angles in radians.
 */
#ifndef TRIAD_TYPES_H
#define TRIAD_TYPES_H

#ifdef __OPENCL_C_VERSION__
#define TRIAD_SIZE(type, bytes) typedef char type##_has_##bytes##_bytes[sizeof(type) == (bytes) ? 1 : -1]
#else
#include <cstdint>
namespace triad::dev { /* triad::Material is the scene's, triad::dev::Material the kernels' */
using uint = std::uint32_t;
using ushort = std::uint16_t;
#define TRIAD_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type " has " #bytes " bytes")
#endif

#define TRIAD_NONE 0xffffffffu /* no index: no texture, no attribute, no primitive */

/* ---- Traversal ---- */

#define BVH_EMPTY 0xffffffffu    /* child slot without a child */
#define BVH_LEAF 0x80000000u     /* child = BVH_LEAF | index of a TriangleBlock */
#define BVH_INSTANCE 0x40000000u /* child = BVH_INSTANCE | index of an Instance (top level only) */
#define BVH_INDEX 0x3fffffffu    /* else: index of a node */
#define BVH_ALPHA 0x40000000u    /* of a BVH_LEAF: some triangle is not opaque, coverage must be asked */
/* Two layouts of nodes, over the same leaves. Boxes are padded at build so that the slab test in float misses
 * nothing. Units of the space the tree lives in (world rebased, or object). */
#define BVH_FORMATS 2
/* Children that wait at most while one tree is walked, nearer ones first; the builder keeps to it. With
 * instances there are two levels of trees. */
#define BVH8_STACK 64
#define BVH4_STACK 40

/* Eight boxes in SoA: bounds[axis * 2] are the low, bounds[axis * 2 + 1] the high planes. The box of an empty
 * slot is inverted (lo = +inf, hi = -inf). */
typedef struct Bvh8Node {
    float bounds[6][8];
    uint child[8];
    uint unused[8];
} Bvh8Node;
TRIAD_SIZE(Bvh8Node, 256);

/* Four boxes on a grid of bytes: byte c of bounds[axis * 2] is the low, of bounds[axis * 2 + 1] the high
 * plane of child c, in cells from the grid's origin. Byte `axis` of cells is the biased exponent of a cell's
 * size, as float has it. After Ylitie, Karras, Laine, "Efficient incoherent ray traversal on GPUs through
 * compressed wide BVHs" (2017). */
typedef struct Bvh4Node {
    float origin[3];
    uint cells;
    uint bounds[6];
    uint child[4];
    uint unused[2];
} Bvh4Node;
TRIAD_SIZE(Bvh4Node, 64);

/* Of the format that a program walks. */
#ifdef __OPENCL_C_VERSION__
#if TRIAD_BVH4
typedef Bvh4Node BvhNode;
#else
typedef Bvh8Node BvhNode;
#endif
#else
struct BvhNode;
#endif

/* Four triangles in SoA; a short block repeats its last triangle. vertex[corner * 3 + axis][lane].
 * `primitive` indexes the scene's Triangle array, over all meshes. */
typedef struct TriangleBlock {
    float vertex[9][4];
    uint primitive[4];
    uint geometry[4]; /* of the primitive: a hit needs no further array to know its material */
} TriangleBlock;
TRIAD_SIZE(TriangleBlock, 176);

/* A mesh placed in the world. Instance 0 is the world itself (identity): flattened geometry belongs to it.
 * Matrices are 3x4, row-major, between object space and rebased world space. */
typedef struct Instance {
    float to_world[12];
    float to_object[12];
    uint root[BVH_FORMATS]; /* node of the mesh's tree, by TRIAD_BVH4 */
    uint unused[6];
} Instance;
TRIAD_SIZE(Instance, 128);

/* A ray and what it must not hit again: the triangle it leaves (TRIAD_NONE: none). t is measured in lengths
 * of `direction`, which need not be normalised. */
typedef struct Ray {
    float origin[3];
    float t_max;
    float direction[3];
    uint skip_instance;
    uint skip_primitive;
    uint unused[3];
} Ray;
TRIAD_SIZE(Ray, 48);

/* Closest hit; primitive is TRIAD_NONE when there is none. u, v are the barycentric weights of corners 1
 * and 2. At equal t the lower (instance, primitive) wins on every device. */
typedef struct Hit {
    float t, u, v;
    uint primitive;
    uint instance;
    uint block; /* 4 * the TriangleBlock that holds it + its lane: where its corners are */
    uint unused[2];
} Hit;
TRIAD_SIZE(Hit, 32);

/* ---- Geometry ---- */

/* Corner indices are relative to the geometry's attribute arrays. */
typedef struct Triangle {
    uint vertex[3];
    uint geometry;
} Triangle;
TRIAD_SIZE(Triangle, 16);

/* One glTF primitive. The attribute members are the index of its first vertex in that attribute's array, or
 * TRIAD_NONE. Directions of flattened geometry are in rebased world space, of instanced in object space; the
 * positions are in the TriangleBlocks. */
typedef struct Geometry {
    uint first_triangle;
    uint material;
    uint normal;      /* float[3], unit; TRIAD_NONE: flat */
    uint tangent;     /* float[4], w = handedness */
    uint uv[2];       /* float[2] */
    uint colour;      /* float[4], linear */
    uint first_light; /* light of triangle first_triangle when the material emits (one light per triangle),
                         else NONE */
    uint touching;    /* solid body: material of the body whose surface coincides with these triangles, facing
                       * the other    way, or TRIAD_NONE. The tree holds one of the two surfaces */
    uint unused[3];
} Geometry;
TRIAD_SIZE(Geometry, 48);

/* ---- Textures and materials ---- */

#define TEXTURE_RGBA8 0u      /* one uint per texel, R in the low byte */
#define TEXTURE_RGBA8_SRGB 1u /* the same, RGB decoded with the sRGB curve */
#define TEXTURE_RGBA16 2u     /* two uints per texel, unsigned normalised */

#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u

/* One image with one sampler. Row 0 is the top row, (u, v) = (0, 0) its upper left corner, as in glTF. */
typedef struct Texture {
    uint width, height;
    uint first_texel; /* index into the texel array, in uints */
    uint format;
    uint wrap_u, wrap_v;
    uint linear; /* 1 bilinear, 0 nearest */
    uint unused;
} Texture;
TRIAD_SIZE(Texture, 32);

/* A use of a texture: which UV set, and KHR_texture_transform as u' = m[0] u + m[1] v + m[2], v' = m[3] u +
 * ... */
typedef struct TextureUse {
    uint texture;
    uint uv_set;
    float m[6];
} TextureUse;
TRIAD_SIZE(TextureUse, 32);

#define MATERIAL_DOUBLE_SIDED 1u /* emits on both sides */
#define MATERIAL_ALPHA_MASK 2u
#define MATERIAL_ALPHA_BLEND 4u
#define MATERIAL_SOLID                                                                               \
    8u /* KHR_materials_volume with thickness > 0: a closed body that absorbs, and refracts where it \
          transmits */
#define MATERIAL_UNLIT 16u

/* Below this roughness squared a surface is a mirror: float directions cannot resolve it. */
#define BSDF_SMOOTH_ALPHA 1e-3f
/* A body whose index differs from 1 by less is taken as smooth: its roughness would blur what is behind by
 * less than alpha / 100, and half vectors lose their meaning. */
#define BSDF_SAME_INDEX 1e-2f

/* glTF metallic-roughness with KHR ior, specular, transmission, volume, emissive_strength, unlit.
 * The *_use members index the TextureUse array or are TRIAD_NONE. Factors multiply textures, as the
 * extensions say. */
typedef struct Material {
    float base_colour[4];
    float emission[3]; /* radiance, strength included */
    float alpha_cutoff;
    float metallic;
    float roughness;
    float ior; /* 0: Fresnel is 1 everywhere (KHR_materials_ior) */
    float normal_scale;
    float specular_colour[3];
    float specular;
    float absorption[3]; /* sigma_a of the body, per scene unit of the instance's world scale */
    float transmission;
    uint flags;
    uint base_colour_use;
    uint metallic_roughness_use;
    uint normal_use;
    uint emission_use;
    uint specular_use;
    uint specular_colour_use;
    uint transmission_use;
    uint dispersion; /* of a solid body: its table of indices, or TRIAD_NONE */
    uint priority;   /* of a solid body among others that overlap it */
    uint extensions; /* index of its MaterialExtensions, or TRIAD_NONE */
    uint unused;
} Material;
TRIAD_SIZE(Material, 128);

/* What some materials have besides: a block for each extension, which is read only where its option of
 * features.h is on. A block with a factor (strength, colour) of 0 does nothing. *_use as in Material. */

/* KHR_materials_clearcoat: a varnish of index 1.5 over everything else. */
typedef struct ClearcoatBlock {
    float factor, roughness, normal_scale;
    uint factor_use, roughness_use, normal_use; /* R; G */
} ClearcoatBlock;
TRIAD_SIZE(ClearcoatBlock, 24);

/* KHR_materials_sheen. */
typedef struct SheenBlock {
    float colour[3], roughness;
    uint colour_use, roughness_use; /* sRGB; A */
} SheenBlock;
TRIAD_SIZE(SheenBlock, 24);

/* KHR_materials_anisotropy: direction is (cos, sin) of the rotation, from the tangent towards the bitangent.
 */
typedef struct AnisotropyBlock {
    float strength, direction[2];
    uint use; /* RG: direction as [-1, 1]; B: strength */
} AnisotropyBlock;
TRIAD_SIZE(AnisotropyBlock, 16);

/* KHR_materials_iridescence: a thin film over the base, thicknesses in nm. */
typedef struct IridescenceBlock {
    float factor, ior, thickness_minimum, thickness_maximum;
    uint factor_use, thickness_use; /* R; G: from minimum to maximum (none: the maximum) */
} IridescenceBlock;
TRIAD_SIZE(IridescenceBlock, 24);

/* KHR_materials_diffuse_transmission: share of the Lambert base that leaves on the other side. */
typedef struct DiffuseTransmissionBlock {
    float factor, colour[3];
    uint factor_use, colour_use; /* A; sRGB */
} DiffuseTransmissionBlock;
TRIAD_SIZE(DiffuseTransmissionBlock, 24);

typedef struct MaterialExtensions {
    ClearcoatBlock clearcoat;
    SheenBlock sheen;
    AnisotropyBlock anisotropy;
    IridescenceBlock iridescence;
    DiffuseTransmissionBlock diffuse_transmission;
    uint unused[4];
} MaterialExtensions;
TRIAD_SIZE(MaterialExtensions, 128);

/* Directional-albedo tables, one float array (host/pack/albedo_tables.h, kernels/shading/albedo.h).
 * First GGX reflection: [roughness][sqrt(mu)][2] = (E with Fresnel 1, E with Fresnel (1 - cos)^5), axes over
 * [0, 1]. Then rough dielectric bodies: [outside, inside][index][roughness][sqrt(mu)][2], node i of the index
 * axis at (n - 1) / (n + 1) = ALBEDO_GLASS_MAX (i / (ALBEDO_GLASS_SIZE - 1))^2; the last is n = 4. Then
 * stretched GGX reflection: [roughness][strength][azimuth of wo over [0, pi/2]][sqrt(mu)][2] as the first.
 * Then the white sheen lobe: [roughness from SHEEN_MIN_ROUGHNESS to 1][sqrt(mu)]. */
#define ALBEDO_SIZE 32
#define ALBEDO_GLASS_SIZE 16
#define ALBEDO_GLASS_MAX 0.6f
#define ALBEDO_GLASS_FIRST (ALBEDO_SIZE * ALBEDO_SIZE * 2)
#define ALBEDO_ANISOTROPIC_FIRST \
    (ALBEDO_GLASS_FIRST + 2 * ALBEDO_GLASS_SIZE * ALBEDO_GLASS_SIZE * ALBEDO_GLASS_SIZE * 2)
#define ALBEDO_LONG 16
#define ALBEDO_SHORT 8
#define ALBEDO_SHEEN_FIRST \
    (ALBEDO_ANISOTROPIC_FIRST + ALBEDO_LONG * ALBEDO_SHORT * ALBEDO_SHORT * ALBEDO_LONG * 2)
#define ALBEDO_FLOATS (ALBEDO_SHEEN_FIRST + ALBEDO_SIZE * ALBEDO_SIZE)
/* Below it fibres would be flat. */
#define SHEEN_MIN_ROUGHNESS 0.07f

/* Thin films (kernels/shading/thin_film.h): how many reflections within the film are told apart, and the
 * table of mean cosines: rows of FILM_STEP nm of optical path difference, three channels each. */
#define FILM_ORDERS 10
#define FILM_ROWS 2049
#define FILM_STEP 5.0f

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

/* colour: radiance factor of a triangle (texture not included), intensity W/sr of point and spot, irradiance
 * of directional. Emissive geometry is always flattened, so positions are in rebased world space. */
typedef struct Light {
    uint type;
    uint primitive;    /* TRIANGLE: its Triangle */
    float pick;        /* probability that light sampling picks this light */
    float area;        /* TRIANGLE */
    float position[3]; /* corner 0, or the position */
    float range;       /* punctual; 0 = no limit */
    float edge1[3];    /* TRIANGLE: corner 1 - corner 0 */
    float cone_scale;  /* SPOT: attenuation = clamp(cos * scale + offset, 0, 1)^2 */
    float edge2[3];    /* TRIANGLE: corner 2 - corner 0 */
    float cone_offset;
    float axis[3]; /* unit; TRIANGLE: normal of the front; SPOT, DIRECTIONAL: where the light goes */
    uint flags;    /* MATERIAL_DOUBLE_SIDED of the triangle's material; LIGHT_PHOTONS; LIGHT_SPECTRUM_SHIFT */
    float colour[3];
    float area_per_pick; /* TRIANGLE: area / pick */
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
    uint unused;
    float extent[2]; /* half width and half height of the image plane at distance 1 (orthographic: in scene
                        units) */
    float pixels[2]; /* width and height of the full picture */
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

/* Of the samples of a pixel. A vertex is the end of an edge that hit something. */
typedef struct PixelWork {
    RayWork rays[WORK_KINDS];
    uint vertices;
    uint unused;
} PixelWork;
TRIAD_SIZE(PixelWork, 80);

/* Tone maps of kernels/subpixel/tone_map.h */
#define TONE_MAP_NONE 0u
#define TONE_MAP_KHRONOS 1u
#define TONE_MAP_ACES 2u
#define TONE_MAP_AGX 3u

/* Tone maps of noisy bins (kernels/subpixel/noise.h): floats kept of a pixel, pixels looked at around. */
#define NOISE_RECORD 20
#define NOISE_REACH 3

/* When the pipeline from bins to drives (kernels/subpixel/) maps tones */
#define TONE_PER_PIXEL 0u   /* what the taps have added up */
#define TONE_PER_BIN 1u     /* every bin, so that the taps add light that a display shows */
#define TONE_NEVER 3u       /* scene-linear radiance goes through */
#define TONE_BIN_ENCODED 2u /* every bin, and the taps add its sRGB-encoded values */

/* Some rows of the picture on their way from bins to drives. Values lie in planes, one for each channel and
 * each column of a cell of pixels, [channel][column][row][cell]: neighbours in memory are the same column of
 * neighbouring cells, which share their taps. A plane has cells left and right of the picture, and rows above
 * and below, that taps reach. */
typedef struct DisplaySlab {
    uint width, height; /* of the picture, in pixels */
    uint columns, rows; /* of the source, in bins: reflected about its edges where it has no bin */
    uint bins[2];       /* per pixel */
    uint cell_x;        /* pixels of a cell, across */
    uint channels;      /* of the planes: 3, or 4 with alpha */
    uint left;          /* cells of a row before the picture's first */
    uint stride;        /* floats of a row of a plane of bins */
    uint plane;         /* floats of a plane of bins */
    int first_row;      /* of the planes of bins: a row of bins of the picture */
    uint source_row; /* first row that is in the source's buffer: of pixels of a film, of bins of an image */
    uint tone_map;   /* TONE_MAP_* */
    uint order;      /* TONE_PER_PIXEL ... */
    uint encoded;    /* 1: the source holds sRGB-encoded values, which are not to be tone-mapped again */
    float unit;      /* of a film's sums */
    float exposure;  /* factor of radiance */
    float background[4]; /* display-linear; the last is 1 where there is one, else 0 */
} DisplaySlab;
TRIAD_SIZE(DisplaySlab, 88);

#ifndef __OPENCL_C_VERSION__
}  // namespace triad::dev
#endif
#endif
