#pragma once
/// A whole error bench: scenes x settings, scene after scene. Who asks for it knows files and options.
#include <functional>
#include <string>
#include <vector>

#include "bench/error_runs.h"

namespace triad {

/// A scene or a setting by its name, and what was added to `triad render` for it.
struct ErrorSubject {
    std::string name, options;
};

struct ErrorExperiment {
    ErrorPlan
        plan;  ///< reference_spp 0: so many that the reference's variance is small beside the last budget's
    std::vector<ErrorSubject> scenes, settings;  ///< of each, no two with one name
    std::vector<ErrorRun> before;                ///< of an earlier bench, to compare with; empty: none

    std::function<Device&(std::size_t setting)> device;  ///< which lives as long as the experiment
    std::function<Scene(std::size_t scene)> load;
    /// A setting, made ready for a scene that was loaded; `setting` and `device` are filled in later.
    std::function<ErrorCase(std::size_t scene, std::size_t setting, const Scene&)> prepare;
};

/// Results are told apart by names. Throws Error(usage) when two scenes or two settings have one.
void require_different_names(const ErrorExperiment& experiment);

/// Interrupted: says so in the result. Throws what require_different_names() and run_errors() do.
ErrorBench run_experiment(const ErrorExperiment& experiment, const ErrorBenchHost& host);

}  // namespace triad
