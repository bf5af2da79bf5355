/* Samples of one pixel, or of neighbours, whose camera rays are walked together. */
#ifndef TRIAD_PATH_CAMERA_PACKET_H
#define TRIAD_PATH_CAMERA_PACKET_H

#include "path/rays.h"
#include "path/start.h"
#include "traversal/packet.h"

#if TRIAD_PACKETS

typedef struct CameraPacket {
    CameraSample samples[PACKET_RAYS];
    PacketRays rays;
    Hit hits[PACKET_RAYS];
    uint count;
} CameraPacket;

TRIAD_FUNCTION void packet_add(CameraPacket* packet, CameraSample sample) {
    packet_set(&packet->rays, packet->count, sample.ray);
    packet->samples[packet->count++] = sample;
}

/* What the rays of its samples hit; lanes without one follow the last. */
TRIAD_FUNCTION void packet_trace(const Scene* scene, CameraPacket* packet, Tally* tally) {
    if (packet->count == 0u) return;
    const uint last = packet->count - 1u;
    for (uint i = packet->count; i < PACKET_RAYS; ++i)
        packet_set(&packet->rays, i, packet->samples[last].ray);
    Traversal traversal =
        traversal_make(scene->nodes, scene->blocks, scene->instances, scene->frame->root[TRIAD_BVH4]);
#if TRIAD_ALPHA_TEST
    Coverage coverage[PACKET_RAYS];
    for (uint i = 0u; i < PACKET_RAYS; ++i) {
        coverage[i].scene = scene;
        coverage[i].ray = coverage_ray(&packet->samples[min(i, last)].name.path, 1u);
    }
    traversal.context = coverage;
#endif
    traverse_packet(&traversal, &packet->rays, packet->hits);
    tally->rays += packet->count;
}

#endif
#endif
