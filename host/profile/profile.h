#pragma once
/// Where the time of a render goes on a device, kernel by kernel, and how far each is from what the device
/// can do.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/spans.h"
#include "metric/repetitions.h"
#include "profile/device_peaks.h"
#include "profile/kernel_costs.h"
#include "trace/device_scene.h"
#include "trace/work_counter.h"

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
    /// What a work-item had to do, in the mean: of a stage of waves, the share of its slots that had work. 0
    /// without a cost.
    double units_per_item(unsigned runs) const;
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
    WorkCounts counts;                 ///< of no sample: not counted
    std::vector<double> tile_seconds;  ///< Renderer::time_tiles(); empty: not timed
    MemoryUse memory;
    std::vector<Compilation> compilations;
    std::vector<DeviceCommand> commands;  ///< of the last run
    std::int64_t clock_offset = 0;        ///< of the host's clock from the device's, ns
};

/// What commands say: rows, and the queue's times, which are those of the last run. The device, the runs'
/// seconds and samples, and what is counted are the caller's.
void add_commands(Profile& profile, const std::vector<std::vector<DeviceCommand>>& runs,
                  const std::vector<KernelFacts>& facts);

/// What the kernels had to do, of work that was counted on the same picture and nodes of the same format.
void add_costs(Profile& profile, const WorkCounts& counts, const DevicePeaks& peaks);

}  // namespace triad
