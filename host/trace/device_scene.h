#pragma once
/// A packed scene on one device.
#include <memory>

#include "device/device.h"
#include "pack/pack.h"

namespace triad {

/// A photon map on the device; empty where nothing is gathered.
struct PhotonMapBuffers {
    Buffer map, photons, ends;
};

/// The arrays of a packed scene on a device, for any number of pictures. A device that works in the host's
/// memory uses the host's arrays.
class DeviceScene {
  public:
    /// Throws Error(memory). The device must live as long.
    DeviceScene(Device& device, std::shared_ptr<const PackedScene> packed);

    Device& device() const { return device_; }
    const PackedScene& packed() const { return *packed_; }
    const std::shared_ptr<const PackedScene>& shared() const { return packed_; }
    std::uint64_t bytes() const { return bytes_; }

    /// The arguments of SCENE_PARAMETERS (kernels/shading/scene.h), in their order. frame: one dev::Frame;
    /// ray_filter: ray_filter_tables().
    Arguments arguments(const Buffer& frame, const Buffer& ray_filter,
                        const PhotonMapBuffers& photon_map = {}) const;

  private:
    Device& device_;
    std::shared_ptr<const PackedScene> packed_;
    Arguments arrays_;
    std::uint64_t bytes_ = 0;
};

/// The arguments of SCENE_PARAMETERS for one picture of a packed scene, everything copied: for kernels that
/// are run once.
Arguments scene_arguments(Device& device, const PackedScene& packed, const RenderSettings& settings,
                          const PhotonMapBuffers& photon_map = {});

}  // namespace triad
