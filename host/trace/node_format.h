#pragma once
/// Which nodes a device walks (bvh/bvh.h), and how: values of TRIAD_BVH4 and TRIAD_PACKETS of all its
/// programs.
#include "bvh/bvh.h"
#include "device/device.h"

namespace triad {

/// By what a device says of itself, where nothing was measured: GPUs walk bvh4.
BvhFormat default_format(const DeviceInfo& device);

/// What the device's programs walk from now on; bvh8 until this is called.
void set_format(Device& device, BvhFormat format);
BvhFormat format_of(const Device& device);
/// Whether its programs walk the camera's rays in packets (kernels/traversal/packet.h): most CPUs with bvh8
/// do.
bool walks_packets(const Device& device);

/// The pool's nodes of the device's format, on it. `owner` keeps the pool; null: they are copied.
DeviceArray<dev::BvhNode> nodes_on(Device& device, const BvhPool& pool,
                                   std::shared_ptr<const void> owner = {});

}  // namespace triad
