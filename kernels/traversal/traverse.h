/* Rays against trees: closest hit and occlusion.
 *
 * Two walks of a ray over two formats of nodes (TRIAD_BVH4); packet.h has one of several rays. Over eight
 * boxes every lane of the node test belongs to one ray: on a CPU that is where the vector units are, and
 * drivers that vectorise across work-items run it with local size 1 (measured per device, see
 * docs/performance.md). Over four everything is scalar, with few registers and a short stack, for devices
 * whose lanes are the work-items. Both find the same hits, bit for bit: boxes decide nothing (slab.h), and
 * the triangle test is one text.
 *
 * Any bits may stand in a ray (NaN, infinities, no direction): what it hits is then arbitrary, but nothing is
 * read beyond the arrays, and the walk ends. An empty child is never met (slab_intersect), a node is visited
 * once, and the stack holds what the trees allow, whatever the comparisons say.
 *
 * A program that tests coverage (alpha) defines, before it includes this header,
 *   TRAVERSAL_CONTEXT                                             the type of Traversal.context
 *   TRAVERSAL_ACCEPT(context, instance, primitive, u, v)          0: the ray passes through
 * and the second is called for every candidate that would become the hit, in blocks whose leaf has BVH_ALPHA.
 */
#ifndef TRIAD_TRAVERSAL_TRAVERSE_H
#define TRIAD_TRAVERSAL_TRAVERSE_H
#include "traversal/walk4.h"
#include "traversal/walk8.h"

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
