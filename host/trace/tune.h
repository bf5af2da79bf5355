#pragma once
/// What suits this device and driver: measured, kept, and never guessed from a name. Drivers that vectorise
/// across work-items run traversal over wide nodes several times slower unless work-groups have one item;
/// GPUs want small nodes and a full wave.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/device.h"

namespace triad {

/// A value for each axis of a search, both by name: {"format", "bvh8"}, {"local", "64"}. No result of a
/// kernel depends on one.
using Tuning = std::map<std::string, std::string>;

/// One thing that is chosen.
struct TuneAxis {
    const char* name;
    /// In the order of preference: another is taken only where it is clearly faster.
    std::vector<std::string> (*values)(const Device&);
    void (*set)(Device&, const std::string& value);
};

/// What is timed; made once for a device, and run with every combination of values.
class Workload {
  public:
    virtual ~Workload() = default;
    /// Best of a few launches, compilation left out.
    virtual double seconds() = 0;
};

/// Axes that are chosen together, by one workload. A new axis is a row here; one that rays alone do not show
/// (how paths are driven, how many at once) comes with a search of its own.
struct TuneSearch {
    const char* name;
    std::vector<TuneAxis> axes;
    std::unique_ptr<Workload> (*make)(Device&);
};
const std::vector<TuneSearch>& tune_searches();

struct TuneTiming {
    std::string search;
    Tuning values;
    double seconds = 0;
};

/// Runs every search (about a second, and compilation), keeps what it found for this device, driver and
/// kernels, and sets the best.
std::vector<TuneTiming> tune(Device& device);

/// Of each search the values of the fastest run among those that have what is wished for; the preferred one
/// unless another takes 5 % less time, so that noise decides nothing.
Tuning best_of(const std::vector<TuneTiming>& timings, const Tuning& wishes = {});

/// What tune() kept for this device; none: it was never run, or with other axes.
std::optional<std::vector<TuneTiming>> load_timings(const DeviceInfo& device);
/// A cache folder that cannot be written costs a warning only.
void keep_timings(const DeviceInfo& device, const std::vector<TuneTiming>& timings);

/// Sets what is best by what was kept, or tunes now; and returns it. Throws Error(usage) for a wish that no
/// search knows.
Tuning ensure_tuned(Device& device, const Tuning& wishes = {});

/// "format bvh8, local 64"
std::string text_of(const Tuning& tuning);

}  // namespace triad
