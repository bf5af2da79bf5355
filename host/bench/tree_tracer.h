#pragma once
/// Arrays of rays against the tree of one scene on one device.
#include <optional>
#include <vector>

#include "bench/ray_scenes.h"
#include "bvh/bvh.h"
#include "device/device.h"

namespace triad {

class TreeTracer {
  public:
    /// With nodes of the device's format.
    TreeTracer(Device& device, const RayScene& scene);

    /// Uploads; what trace() is run on until the next call.
    void set_rays(const std::vector<dev::Ray>& rays);
    /// One pass over the rays, on the device, results left there; returns when it has ended.
    void trace(bool occluded);
    /// The same for closest hits of neighbours together, none of which skips a triangle.
    void trace_packets();
    /// Whether the device's format of nodes is walked by packets (kernels/traversal/packet.h).
    bool walks_packets() const { return bool(packets_); }
    std::vector<dev::Hit> hits() { return device_.download<dev::Hit>(results_); }
    std::vector<std::uint32_t> occluded();

    double build_seconds() const { return build_seconds_; }
    std::size_t node_bytes() const { return nodes_.bytes(); }
    std::size_t block_bytes() const { return blocks_.bytes(); }

  private:
    void run(const Kernel& kernel, std::size_t items);

    Device& device_;
    Buffer nodes_, blocks_, rays_, results_;
    Kernel closest_, occluded_;
    std::optional<Kernel> packets_;
    std::uint32_t root_ = 0, count_ = 0;
    double build_seconds_ = 0;
};

}  // namespace triad
