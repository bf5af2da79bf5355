/* Arrays of rays against the tree: tests, benchmarks, and the wavefront. */
#include "common/language.h"
#include "traversal/packet.h"
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

#if TRIAD_PACKETS
/* The same, PACKET_RAYS neighbours together, none of which skips a triangle. One work-item for each packet.
 */
kernel void intersect_packets(global const BvhNode* nodes, global const TriangleBlock* blocks,
                              global const Instance* instances, uint root, global const Ray* rays,
                              global Hit* hits, uint count) {
    const size_t first = get_global_id(0) * PACKET_RAYS;
    if (first >= count) return;
    const Traversal scene = traversal_make(nodes, blocks, instances, root);
    const uint here = min(count - (uint)first, (uint)PACKET_RAYS);
    PacketRays packet;
    for (uint i = 0u; i < PACKET_RAYS; ++i) packet_set(&packet, i, rays[first + min(i, here - 1u)]);
    Hit found[PACKET_RAYS];
    traverse_packet(&scene, &packet, found);
    for (uint i = 0u; i < here; ++i) hits[first + i] = found[i];
}
#endif

/* occluded[i] = 1 when rays[i] hits anything. */
kernel void intersect_occluded(global const BvhNode* nodes, global const TriangleBlock* blocks,
                               global const Instance* instances, uint root, global const Ray* rays,
                               global uint* occluded, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Traversal scene = traversal_make(nodes, blocks, instances, root);
    occluded[i] = (uint)traverse_occluded(&scene, rays[i]);
}
