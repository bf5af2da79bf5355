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
    /// In the order of preference: another is taken only where it is clearly faster, and the first where
    /// nothing was measured. The axes before it in its search are set when this is asked, so that an axis of
    /// which some of their values know nothing can say so by a single value.
    std::vector<std::string> (*values)(const Device&);
    bool (*knows)(const std::string& value);  ///< on any device
    void (*set)(Device&, const std::string& value);
};

/// What is timed; made once for a device, and run with every combination of values.
class Workload {
  public:
    virtual ~Workload() = default;
    /// Best of a few launches, compilation left out.
    virtual double seconds() = 0;
};

enum class TuneWhen {
    first_use,  ///< before a device is first used: a second of work
    asked       ///< by triad tune alone: it compiles what renders may never need
};

/// Axes that are chosen together, by one workload. A new axis is a row here; one that no workload shows
/// comes with a search of its own. Searches are run in their order, each with the best of those before it.
struct TuneSearch {
    const char* name;
    TuneWhen when;
    std::vector<TuneAxis> axes;
    /// Called when every axis has its preferred value.
    std::unique_ptr<Workload> (*make)(Device&);
};
const std::vector<TuneSearch>& tune_searches();

struct TuneTiming {
    std::string search;
    Tuning values;
    double seconds = 0;
};

/// Times every combination of values. One that the device refuses is left out with a warning; throws its
/// DeviceError when it refuses all.
std::vector<TuneTiming> time_search(Device& device, const TuneSearch& search);

/// Runs every search, keeps what it found for this device, driver and kernels, and sets the best.
std::vector<TuneTiming> tune(Device& device);

/// Of each search the values of the fastest run among those that have what is wished for; the preferred one
/// unless another takes 5 % less time, so that noise decides nothing.
Tuning best_of(const std::vector<TuneTiming>& timings, const Tuning& wishes = {});

/// What was kept for this device, of searches whose axes are still the same; none: not all of what its first
/// use measures is there.
std::optional<std::vector<TuneTiming>> load_timings(const DeviceInfo& device);
/// A cache folder that cannot be written costs a warning only.
void keep_timings(const DeviceInfo& device, const std::vector<TuneTiming>& timings);

/// Sets what is best by what was kept, and returns it: a value for every axis. Where nothing was kept, the
/// searches of first use are run now. Axes that were not measured get what is wished for, or the preferred
/// value. Throws Error(usage) for a wish that no search knows.
Tuning ensure_tuned(Device& device, const Tuning& wishes = {});

/// "format bvh8, local 64"
std::string text_of(const Tuning& tuning);

}  // namespace triad
