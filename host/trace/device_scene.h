#pragma once
/// A packed scene on one device.
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/device.h"
#include "pack/pack.h"
#include "trace/kernel_arguments.h"

namespace triad {

/// A photon map on the device; empty where nothing is gathered.
struct PhotonMapBuffers {
    DeviceArray<dev::PhotonMap> map;
    DeviceArray<dev::Photon> photons;
    DeviceArray<std::uint32_t> ends;
};

/// Bytes on a device, by what they are for.
using MemoryUse = std::vector<std::pair<std::string, std::uint64_t>>;

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
    /// Of every array that is not empty, by its name in kernels/arguments.h.
    MemoryUse memory() const;

    /// What kernels that shade begin with. frame: one; ray_filter: ray_filter_tables().
    Arguments arguments(const DeviceArray<dev::Frame>& frame, const DeviceArray<float>& ray_filter,
                        const PhotonMapBuffers& photon_map = {}) const;

  private:
    Device& device_;
    std::shared_ptr<const PackedScene> packed_;
    dev::SceneArguments arrays_;  ///< but for what a picture adds
    std::uint64_t bytes_ = 0;
};

/// The arguments of a scene for one picture of a packed scene, everything copied: for kernels that
/// are run once.
Arguments scene_arguments(Device& device, const PackedScene& packed, const RenderSettings& settings,
                          const PhotonMapBuffers& photon_map = {});

}  // namespace triad
