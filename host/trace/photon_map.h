#pragma once
/// A photon map on a device: where photons land, and the hash grid that they are sorted into
/// (kernels/photon/map.cl, kernels/shading/photon_map.h).
#include "device/device.h"
#include "trace/device_scene.h"

namespace triad {

class PhotonMap {
  public:
    PhotonMap() = default;
    /// Room for so many photons. Throws Error(memory) with a sentence where the device has less.
    PhotonMap(Device& device, std::uint64_t photons);
    explicit operator bool() const { return bool(landed_); }

    void compile(const Options& options);
    /// Sorts the first `count` of the photons that landed; those that landed nowhere have direction 0.
    /// shape: its radii and wavelengths; the rest is filled in.
    void sort(dev::PhotonMap shape, std::uint64_t count);

    const DeviceArray<dev::Photon>& landed() const { return landed_; }  ///< to be written by a kernel
    const PhotonMapBuffers& buffers() const { return buffers_; }
    std::uint64_t bytes() const;

  private:
    Device* device_ = nullptr;
    std::size_t buckets_ = 0;
    DeviceArray<dev::Photon> landed_;
    DeviceArray<std::uint32_t> chunk_sums_;
    PhotonMapBuffers buffers_;
    Kernel count_, sum_chunks_, scan_chunks_, scan_buckets_, sort_;
};

}  // namespace triad
