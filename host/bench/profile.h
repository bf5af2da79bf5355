#pragma once
/// Where the time of a render goes on a device, kernel by kernel, and how far each is from what the device
/// can do.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/spans.h"
#include "bench/device_peaks.h"
#include "bench/kernel_costs.h"
#include "bench/repetitions.h"
#include "render/renderer.h"

namespace triad {

/// The least time that a device could take for a kernel's work, were all its data in the nearest cache, and
/// by what.
struct Floor {
    double seconds = 0;
    std::string by;  ///< "memory", "arithmetic", "latency"
};

Floor floor_of(const KernelCost& cost, const DevicePeaks& peaks);

/// A kernel, or "write", "read", "fill", in all runs together where nothing else is said.
struct KernelRow {
    std::string kernel, program;
    CommandKind kind = CommandKind::kernel;
    std::size_t launches = 0, items = 0, bytes_moved = 0;
    double ms_median = 0, ms_p95 = 0;  ///< of a launch
    std::vector<double> ms_of_runs;    ///< of all its launches, in each run
    Estimate ms;                       ///< their median
    double share = 0;                  ///< of the device's time
    double items_per_s = 0;            ///< of work-items; units below are what they work on
    std::optional<KernelCost> cost;    ///< of a run
    std::optional<Floor> floor;        ///< of a run
    KernelFacts facts;

    double seconds() const { return 1e-3 * ms.value; }  ///< of a run
    /// Per second, by what its cost counts; 0 without one.
    double bytes_per_s() const;
    double flops_per_s() const;
    /// How much of what the device can do: 1 is the roof. None without a cost.
    std::optional<double> roofline_share() const;
};

struct Profile {
    DeviceInfo device;
    std::string format, path_driver;
    unsigned runs = 0;
    double samples = 0;                   ///< of a run, over all pixels
    std::vector<double> seconds_of_runs;  ///< of rendering, by the host's clock
    std::vector<KernelRow> rows;          ///< by falling share
    double busy = 0, waiting = 0;         ///< seconds of the queue in a run: at work; between two commands
    double host_between = 0;              ///< seconds of a run in which no command was queued or at work
    DevicePeaks peaks;
    WorkCounts counts;
    std::vector<double> tile_seconds;  ///< Renderer::time_tiles()
    MemoryUse memory;
    std::vector<Compilation> compilations;
    std::vector<DeviceCommand> commands;  ///< of the last run
    std::int64_t clock_offset = 0;        ///< of the host's clock from the device's, ns
};

/// Samples of each pixel whose work is counted: few, since nothing but their mean is used.
constexpr unsigned counted_samples = 4;

/// Renders the goal's samples so many times, each from an empty film and with a seed of its own, after a run
/// that warms up with this one. The renderer's only device must have a profiling queue. report(done, all) is
/// called after each run and returns false to stop: what there is then is the profile. Nothing is in it of
/// work, tiles and peaks.
Profile profile_runs(Renderer& renderer, const RenderGoal& goal, std::uint32_t seed, unsigned runs,
                     const std::function<bool(unsigned, unsigned)>& report);

/// What the kernels had to do, of work that was counted on the same picture and nodes of the same format.
void add_costs(Profile& profile, const WorkCounts& counts, const DevicePeaks& peaks);

/// Both, with work counted, tiles timed and peaks measured after the runs.
Profile profile(Renderer& renderer, const RenderGoal& goal, std::uint32_t seed, unsigned runs,
                const std::function<bool(unsigned, unsigned)>& report);

}  // namespace triad
