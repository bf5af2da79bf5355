/* Trees, rays and what triangles are made of. Part of types.h. */
#ifndef TRIAD_TYPES_GEOMETRY_H
#define TRIAD_TYPES_GEOMETRY_H

#include "types/border.h"

TRIAD_TYPES_BEGIN

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

/* Rays that are walked together (traversal/packet.h). */
#define PACKET_RAYS 8

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

TRIAD_TYPES_END

#endif
