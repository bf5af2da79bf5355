/* Rays against the eight-wide tree: closest hit and occlusion.
 *
 * Every lane of the node test belongs to one ray (eight boxes at once): on a CPU that is where the vector
 * units are, and drivers that vectorise across work-items run it with local size 1 (measured per device, see
 * docs/performance.md). The slab test is one fma per plane over boxes that the builder padded for its
 * rounding (host/bvh/bvh.h), so that a box is never missed whose triangle is hit, and a box's entry is never
 * beyond the t of a triangle inside: results do not depend on the order of visits.
 *
 * Any bits may stand in a ray (NaN, infinities, no direction): what it hits is then arbitrary, but nothing is
 * read beyond the arrays, and the walk ends. An empty child is never met (slab_intersect), a node is visited
 * once, and the stack holds what the depth of the trees allows, whatever the comparisons say.
 *
 * A program that tests coverage (alpha) defines, before it includes this header,
 *   TRAVERSAL_CONTEXT                                             the type of Traversal.context
 *   TRAVERSAL_ACCEPT(context, instance, primitive, u, v)          0: the ray passes through
 * and the second is called for every candidate that would become the hit, in blocks whose leaf has BVH_ALPHA.
 */
#ifndef TRIAD_TRAVERSAL_TRAVERSE_H
#define TRIAD_TRAVERSAL_TRAVERSE_H
#include "common/math.h"
#include "traversal/triangle.h"

#define TRAVERSAL_TESTS_ALPHA 0
#ifdef TRAVERSAL_ACCEPT
#undef TRAVERSAL_TESTS_ALPHA
#define TRAVERSAL_TESTS_ALPHA TRIAD_ALPHA_TEST
#endif

/* What rays are traced against. Pass it by pointer: it dissolves when inlined. */
typedef struct Traversal {
    global const BvhNode* nodes;
    global const TriangleBlock* blocks;
    global const Instance* instances; /* read only where a leaf has BVH_INSTANCE */
    uint root;
#ifdef TRAVERSAL_CONTEXT
    TRAVERSAL_CONTEXT context;
#endif
} Traversal;

/* root: node of the tree that rays begin in. The context, where there is one, is the caller's to set. */
TRIAD_FUNCTION Traversal traversal_make(global const BvhNode* nodes, global const TriangleBlock* blocks,
                                        global const Instance* instances, uint root) {
    Traversal t;
    t.nodes = nodes;
    t.blocks = blocks;
    t.instances = instances;
    t.root = root;
    return t;
}

/* What the slab test needs of a ray, once per ray and space. t of a plane at b is fma(b, inverse, -origin *
 * inverse). */
typedef struct SlabRay {
    float inverse[3];
    float offset[3];  /* -origin * inverse */
    uint near_row[3]; /* first float of the row of BvhNode.bounds that the ray meets first; the other one is ^
                         8 */
} SlabRay;

TRIAD_FUNCTION SlabRay slab_ray(const float origin[3], const float direction[3]) {
    /* A component of zero becomes 2^-40 of the largest: finite, so that no plane yields 0 * inf, far below
     * the padding of the boxes, and relative, so that scaling by a power of two changes no bit. */
    const float x = fabs(direction[0]), y = fabs(direction[1]), z = fabs(direction[2]);
    const float least = math_max(x, math_max(y, z)) * 0x1p-40f;
    SlabRay ray;
    for (int axis = 0; axis < 3; ++axis) {
        const float inverse = 1.0f / copysign(math_max(fabs(direction[axis]), least), direction[axis]);
        ray.inverse[axis] = inverse;
        ray.offset[axis] = -origin[axis] * inverse;
        ray.near_row[axis] = (uint)axis * 16u + (inverse < 0.0f ? 8u : 0u);
    }
    return ray;
}

/* Eight boxes: entry distances, and the top bit of a byte for each child that the ray meets within [0,
 * t_max]. */
TRIAD_FUNCTION ulong slab_intersect(global const BvhNode* node, const SlabRay* ray, float t_max,
                                    float8* entry) {
    global const float* bounds = &node->bounds[0][0];
    const float8 ix = (float8)(ray->inverse[0]), iy = (float8)(ray->inverse[1]),
                 iz = (float8)(ray->inverse[2]);
    const float8 ox = (float8)(ray->offset[0]), oy = (float8)(ray->offset[1]), oz = (float8)(ray->offset[2]);
    const float8 nx = fma(vload8(0, bounds + ray->near_row[0]), ix, ox);
    const float8 ny = fma(vload8(0, bounds + ray->near_row[1]), iy, oy);
    const float8 nz = fma(vload8(0, bounds + ray->near_row[2]), iz, oz);
    const float8 fx = fma(vload8(0, bounds + (ray->near_row[0] ^ 8u)), ix, ox);
    const float8 fy = fma(vload8(0, bounds + (ray->near_row[1] ^ 8u)), iy, oy);
    const float8 fz = fma(vload8(0, bounds + (ray->near_row[2] ^ 8u)), iz, oz);
    /* Ternaries, not fmin and fmax: no operand is NaN, and these are one instruction each. */
    float8 tn = nx > ny ? nx : ny, tf = fx < fy ? fx : fy;
    tn = tn > nz ? tn : nz;
    tf = tf < fz ? tf : fz;
    tn = tn > 0.0f ? tn : (float8)(0.0f);
    /* This way round NaN stays NaN: the far planes of an empty child are -inf or NaN whatever the ray is. */
    tf = t_max < tf ? (float8)(t_max) : tf;
    *entry = tn;
    return as_ulong(convert_char8(tn <= tf)) & 0x8080808080808080ul;
}

/* Takes the lowest child out of a mask of slab_intersect and returns its number. */
TRIAD_FUNCTION uint slab_next(ulong* mask) {
    const uint child = (uint)(63 - clz(*mask & (0 - *mask))) >> 3;
    *mask &= *mask - 1;
    return child;
}

#if TRIAD_INSTANCES
TRIAD_FUNCTION void traversal_to_object(global const Instance* instance, const Ray* ray, float origin[3],
                                        float direction[3]) {
    global const float* m = instance->to_object;
    for (int row = 0; row < 3; ++row, m += 4) {
        origin[row] = fma(m[0], ray->origin[0], fma(m[1], ray->origin[1], fma(m[2], ray->origin[2], m[3])));
        direction[row] = fma(m[0], ray->direction[0], fma(m[1], ray->direction[1], m[2] * ray->direction[2]));
    }
}
#endif

/* A candidate of a block against the best hit so far: nearer, or as near and of lower (instance, primitive).
 */
TRIAD_FUNCTION int traversal_is_better(const Hit* best, float t, uint instance, uint primitive) {
    return t < best->t || (t == best->t && (instance < best->instance ||
                                            (instance == best->instance && primitive < best->primitive)));
}

/* Tests the block of a leaf; with `any` returns 1 at the first hit, else updates `best` and returns 0. */
TRIAD_FUNCTION int traversal_visit_leaf(const Traversal* scene, uint leaf, const TriangleRay* ray,
                                        uint instance, uint skip, Hit* best, const int any) {
    global const TriangleBlock* block = scene->blocks + (leaf & BVH_INDEX);
    TriangleHits hits;
    const int4 lanes = triangle_intersect(block, ray, best->t, skip, &hits);
    const int2 pairs = lanes.lo | lanes.hi;
    if ((pairs.x | pairs.y) == 0) return 0;
#if !TRAVERSAL_TESTS_ALPHA
    if (any) return 1;
#endif
    /* Selects: as_uint(convert_char4(lanes)) kills Intel's compiler for GPUs (IGC 1.0.12504). */
    uint mask = (lanes.s0 ? 0xffu : 0u) | (lanes.s1 ? 0xff00u : 0u) | (lanes.s2 ? 0xff0000u : 0u) |
                (lanes.s3 ? 0xff000000u : 0u);
    float t[4], u[4], v[4];
    vstore4(hits.t, 0, t);
    vstore4(hits.u, 0, u);
    vstore4(hits.v, 0, v);
    do {
        const uint lane = (31u - clz(mask & (0u - mask))) >> 3;
        mask &= ~(0xffu << (lane * 8u));
        const uint primitive = block->primitive[lane];
        if (!any && !traversal_is_better(best, t[lane], instance, primitive)) continue;
#if TRAVERSAL_TESTS_ALPHA
        if ((leaf & BVH_ALPHA) && !TRAVERSAL_ACCEPT(scene->context, instance, primitive, u[lane], v[lane]))
            continue;
        if (any) return 1;
#endif
        best->t = t[lane];
        best->u = u[lane];
        best->v = v[lane];
        best->primitive = primitive;
        best->instance = instance;
        best->block = (leaf & BVH_INDEX) * 4u + lane;
    } while (mask != 0u);
    return 0;
}

/* Asks for what a child that goes to the stack will be read from: scenes beyond the cache walk up to a tenth
 * faster. */
TRIAD_FUNCTION void traversal_prefetch(const Traversal* scene, uint child) {
    if (child & BVH_LEAF) {
        global const char* block = (global const char*)(scene->blocks + (child & BVH_INDEX));
        TRIAD_PREFETCH(block);
        TRIAD_PREFETCH(block + 64);
        TRIAD_PREFETCH(block + 128);
    } else if (!(child & BVH_INSTANCE)) {
        global const char* node = (global const char*)(scene->nodes + child);
        TRIAD_PREFETCH(node);
        TRIAD_PREFETCH(node + 64);
        TRIAD_PREFETCH(node + 128);
        TRIAD_PREFETCH(node + 192);
    }
}

/* A child and where the ray enters it, which is not negative: packs compare as their entries. */
TRIAD_FUNCTION ulong traversal_pack(uint child, float entry) { return (ulong)as_uint(entry) << 32 | child; }

/* The walk. `any` is a constant of the call: 1 stops at the first hit and returns 1, 0 leaves the closest in
 * `best`. */
TRIAD_FUNCTION_PER_CALL int traversal_walk(const Traversal* scene, const Ray* ray, Hit* best, const int any) {
    ulong stack[BVH_STACK];
    uint size = 0u;
    uint child = scene->root;
    uint instance = 0u;
    uint skip = ray->skip_instance == 0u ? ray->skip_primitive : TRIAD_NONE;
    SlabRay slab = slab_ray(ray->origin, ray->direction);
    TriangleRay sheared = triangle_ray(ray->origin, ray->direction);
#if TRIAD_INSTANCES
    uint floor_of_instance = 0u; /* stack size at which the current instance is done */
#endif
    for (;;) {
        if (child & BVH_LEAF) {
            if (traversal_visit_leaf(scene, child, &sheared, instance, skip, best, any)) return 1;
#if TRIAD_INSTANCES
        } else if (child & BVH_INSTANCE) {
            float origin[3], direction[3];
            instance = child & BVH_INDEX;
            traversal_to_object(scene->instances + instance, ray, origin, direction);
            slab = slab_ray(origin, direction);
            sheared = triangle_ray(origin, direction);
            skip = ray->skip_instance == instance ? ray->skip_primitive : TRIAD_NONE;
            floor_of_instance = size;
            child = scene->instances[instance].root;
            continue;
#endif
        } else {
            global const BvhNode* node = scene->nodes + child;
            float8 entries;
            ulong mask = slab_intersect(node, &slab, best->t, &entries);
            if (mask != 0ul) {
                const uint first = slab_next(&mask);
                if (mask == 0ul) {
                    child = node->child[first];
                    continue;
                }
                float entry[8];
                vstore8(entries, 0, entry);
                ulong nearest = traversal_pack(node->child[first], any ? 0.0f : entry[first]);
                const uint floor_of_node = size;
                do { /* the nearest child is walked next, the others lie in order on the stack */
                    const uint next = slab_next(&mask);
                    const ulong other = traversal_pack(node->child[next], any ? 0.0f : entry[next]);
                    const ulong farther = any ? other : max(nearest, other);
                    nearest = any ? nearest : min(nearest, other);
                    uint place = size++;
                    if (!any)
                        for (; place > floor_of_node && stack[place - 1u] < farther; --place)
                            stack[place] = stack[place - 1u];
                    stack[place] = farther;
                    traversal_prefetch(scene, (uint)other);
                } while (mask != 0ul);
                child = (uint)nearest;
                continue;
            }
        }
        do { /* the next child that starts before the best hit */
#if TRIAD_INSTANCES
            if (size == floor_of_instance && instance != 0u) {
                instance = 0u;
                floor_of_instance = 0u;
                slab = slab_ray(ray->origin, ray->direction);
                sheared = triangle_ray(ray->origin, ray->direction);
                skip = ray->skip_instance == 0u ? ray->skip_primitive : TRIAD_NONE;
            }
#endif
            if (size == 0u) return 0;
            child = (uint)stack[--size];
        } while (!any && as_float((uint)(stack[size] >> 32)) > best->t);
    }
}

/* The closest hit with 0 < t <= ray.t_max; t in lengths of ray.direction. Equal t goes to the lower
 * (instance, primitive). The triangle (skip_instance, skip_primitive) is never hit. */
TRIAD_FUNCTION Hit traverse_closest(const Traversal* scene, Ray ray) {
    Hit best;
    best.t = ray.t_max;
    best.u = best.v = 0.0f;
    best.primitive = best.instance = TRIAD_NONE;
    best.block = best.unused[0] = best.unused[1] = 0u;
    traversal_walk(scene, &ray, &best, 0);
    return best;
}

/* 1 when anything is hit with 0 < t <= ray.t_max, else 0. */
TRIAD_FUNCTION int traverse_occluded(const Traversal* scene, Ray ray) {
    Hit best;
    best.t = ray.t_max;
    return traversal_walk(scene, &ray, &best, 1);
}

#endif
