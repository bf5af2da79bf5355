#pragma once
/// How a device follows paths: each to its end before the next, or many side by side, stage by stage. Films
/// are the same bit for bit.
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "pack/features.h"
#include "trace/device_scene.h"

namespace triad {

enum class PathDriverKind {
    /// a work-item follows the paths of a pixel, or of a few neighbours, one after the other
    /// (kernels/path/mega.cl)
    mega,
    /// of CPUs: a work-item takes a pool of paths through one stage after the other (kernels/path/wave.cl)
    wave,
    /// of GPUs: each stage is a launch over all paths that are under way (kernels/path/wave_stages.cl)
    wave_stages
};
constexpr PathDriverKind all_path_drivers[] = {PathDriverKind::mega, PathDriverKind::wave,
                                               PathDriverKind::wave_stages};

const char* name_of(PathDriverKind kind);
/// None: there is no driver of that name.
std::optional<PathDriverKind> find_path_driver(const std::string& name);

/// Where nothing was measured. GPUs: wave_stages, whose kernels take half the registers of mega's.
PathDriverKind default_path_driver(const DeviceInfo& device);

/// What the device follows paths by from now on; mega until this is called.
void set_path_driver(Device& device, PathDriverKind kind);
PathDriverKind path_driver_of(const Device& device);

/// Paths under way for each compute unit, of wave_stages, until set_batch() is called: on an H100 a quarter
/// of them took a fifth more time.
constexpr std::uint32_t paths_per_unit = 8192;
/// How many paths wave_stages keeps under way at most. 0: paths_per_unit for each.
void set_batch(Device& device, std::uint32_t paths);
std::uint32_t batch_of(const Device& device);

class PathDriver {
  public:
    virtual ~PathDriver() = default;

    /// Enqueues the samples that a list of work names. `scene`: what kernels that shade begin with; `work`:
    /// the film and the tiles, which lie in one band.
    virtual void trace(const Arguments& scene, const dev::TracePathsArguments& work) = 0;
    /// What trace() could not enqueue before results were there; waits for all of it but the last launch.
    virtual void finish() {}
    virtual std::uint64_t bytes() const = 0;  ///< of its own
    /// How many times as long as a launch should be a call of trace() may take: many where it makes many
    /// short launches, whose device has less and less to do while the last paths of a call come to their end.
    virtual unsigned launches() const { return 1; }
    /// Of one launch. PoCL compiles a kernel a second time for grids beyond 65,535 items; below, there is one
    /// program for everything, and compiling is over before rendering begins.
    virtual std::size_t most_tiles() const { return std::numeric_limits<std::size_t>::max(); }
};

/// Of the device's kind; compiles the kernels.
std::unique_ptr<PathDriver> make_path_driver(const DeviceScene& scene, const RenderSettings& settings,
                                             const Features& features);

}  // namespace triad
