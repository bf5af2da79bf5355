#pragma once
/// How paths are followed on a device: one launch for whole paths, or a launch for each stage.
#include <memory>

#include "pack/features.h"
#include "trace/device_scene.h"

namespace triad {

class PathDriver {
  public:
    virtual ~PathDriver() = default;

    /// Enqueues the samples that a list of work names: `scene` is what kernels that shade begin with, `work`
    /// the film and the tiles. May wait for the device.
    virtual void trace(const Arguments& scene, const dev::TracePathsArguments& work) = 0;
    virtual std::uint64_t bytes() const { return 0; }
};

/// `mega`: one work-item follows the paths of a pixel (kernels/path/mega.cl).
std::unique_ptr<PathDriver> make_mega(Device& device, const RenderSettings& settings,
                                      const Features& features);

/// `wave`: a launch for each stage over a pool of paths (kernels/path/wave.h).
std::unique_ptr<PathDriver> make_wave(const DeviceScene& scene, const RenderSettings& settings,
                                      const Features& features);

}  // namespace triad
