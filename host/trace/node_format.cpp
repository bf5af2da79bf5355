#include "trace/node_format.h"

#include <cassert>

namespace triad {
namespace {

constexpr const char *option = "TRIAD_BVH4", *packets = "TRIAD_PACKETS";

/// CPUs gain a tenth (PoCL, Intel's runtime). Mesa's rusticl takes minutes longer to compile the path tracer,
/// and its loops end after 65,535 rounds of a work-item, which then has eight pixels.
bool packets_pay(const DeviceInfo& device) { return device.type == "cpu" && device.platform != "rusticl"; }

}  // namespace

BvhFormat default_format(const DeviceInfo& device) {
    return device.type == "gpu" ? BvhFormat::bvh4 : BvhFormat::bvh8;
}

void set_format(Device& device, BvhFormat format) {
    Options shape = device.shape();
    shape[option] = format == BvhFormat::bvh4 ? "1" : "0";
    shape[packets] = format == BvhFormat::bvh8 && packets_pay(device.info()) ? "1" : "0";
    // GPUs keep in memory what a function hands to one that it calls.
    if (device.info().type == "gpu") shape["TRIAD_INLINED"] = "1";
    device.set_shape(std::move(shape));
}

BvhFormat format_of(const Device& device) {
    const auto found = device.shape().find(option);
    return found != device.shape().end() && found->second == "1" ? BvhFormat::bvh4 : BvhFormat::bvh8;
}

bool walks_packets(const Device& device) {
    const auto found = device.shape().find(packets);
    return found != device.shape().end() && found->second == "1";
}

DeviceArray<dev::BvhNode> nodes_on(Device& device, const BvhPool& pool, std::shared_ptr<const void> owner) {
    assert(pool.formats.contains(format_of(device)));
    const auto place = [&](const auto& nodes) -> Buffer {
        const std::span all(nodes.data(), nodes.size());
        return owner ? device.share(all, owner) : device.upload(all);
    };
    return DeviceArray<dev::BvhNode>(format_of(device) == BvhFormat::bvh4 ? place(pool.nodes4)
                                                                          : place(pool.nodes8));
}

}  // namespace triad
