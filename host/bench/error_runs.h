#pragma once
/// Makes the runs of `triad bench error`: renders, reads, measures.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/error_bench.h"
#include "device/device.h"
#include "render/renderer.h"

namespace triad {

struct ErrorPlan {
    std::uint64_t spp = 64;  ///< of the last budget; the others are the powers of two below it
    double seconds = 0;      ///< no budget is begun that would end a run later than this; 0: no limit
    unsigned repetitions = 5;
    std::uint32_t seed = 1;           ///< of repetition 0; the others count on
    std::uint64_t reference_spp = 0;  ///< at least
    bool own_references = false;      ///< of every setting, instead of the first setting's for all
};

/// A setting, made ready for one scene.
struct ErrorCase {
    ErrorSetting setting;
    Device* device = nullptr;
    RenderSettings settings;
    bool adaptive = false;
    /// The film as it is looked at.
    std::function<RgbImage(Device&, const Film&)> display;
};

/// What happens outside of the runs.
struct ErrorBenchHost {
    /// The film that was kept under this key; none: there is none.
    std::function<std::optional<Film>(const std::string& key)> load_reference;
    std::function<void(const std::string& key, const Film&)> keep_reference;
    /// After every pass of a reference; false: stop.
    std::function<bool(const Progress&, double samples)> on_reference;
    /// After every pass of a run; false: stop.
    std::function<bool()> go_on;
    /// After the last budget of a run.
    std::function<void(const ErrorRun&)> on_run;
};

/// Runs all cases on one scene and adds scene, rows and curves to `bench`, as yet with pictures and verdicts
/// alone. `scene` names it. Returns false when it was stopped; what was measured is there. Throws
/// Error(usage) for cases whose pictures differ in size.
bool run_errors(const ErrorPlan& plan, const ErrorScene& name, const Scene& scene,
                std::vector<ErrorCase> cases, const ErrorBenchHost& host, ErrorBench& bench);

/// After the last scene: fills in what curves_of() finds in the rows.
void fit_curves(ErrorBench& bench);

}  // namespace triad
