#pragma once
/// How a device follows paths: each to its end before the next, or many side by side, stage by stage. Films
/// are the same bit for bit.
#include <memory>
#include <optional>
#include <string>

#include "pack/features.h"
#include "trace/device_scene.h"

namespace triad {

enum class PathDriverKind {
    mega,  ///< a work-item follows the paths of a pixel, one after the other (kernels/path/mega.cl)
    wave   ///< a work-item takes a pool of paths through one stage after the other (kernels/path/wave.cl)
};

const char* name_of(PathDriverKind kind);
/// None: there is no driver of that name.
std::optional<PathDriverKind> find_path_driver(const std::string& name);

/// What the device follows paths by from now on; mega until this is called.
void set_path_driver(Device& device, PathDriverKind kind);
PathDriverKind path_driver_of(const Device& device);

class PathDriver {
  public:
    virtual ~PathDriver() = default;

    /// Enqueues the samples that a list of work names. `scene`: what kernels that shade begin with; `work`:
    /// the film and the tiles, which lie in one band.
    virtual void trace(const Arguments& scene, const dev::TracePathsArguments& work) = 0;
    virtual std::uint64_t bytes() const = 0;  ///< of its own
};

/// Of the device's kind; compiles the kernels.
std::unique_ptr<PathDriver> make_path_driver(const DeviceScene& scene, const RenderSettings& settings,
                                             const Features& features);

}  // namespace triad
