/* Arrays of rays against the tree: tests, benchmarks, and the wavefront. */
#include "common/language.h"
#include "traversal/traverse.h"

/* hits[i] = the closest hit of rays[i]. */
kernel void intersect_closest(global const BvhNode* nodes, global const TriangleBlock* blocks,
                              global const Instance* instances, uint root, global const Ray* rays,
                              global Hit* hits, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Traversal scene = traversal_make(nodes, blocks, instances, root);
    hits[i] = traverse_closest(&scene, rays[i]);
}

/* occluded[i] = 1 when rays[i] hits anything. */
kernel void intersect_occluded(global const BvhNode* nodes, global const TriangleBlock* blocks,
                               global const Instance* instances, uint root, global const Ray* rays,
                               global uint* occluded, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Traversal scene = traversal_make(nodes, blocks, instances, root);
    occluded[i] = (uint)traverse_occluded(&scene, rays[i]);
}
