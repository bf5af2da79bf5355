#include "bench/error_experiment.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "bench/error_curves.h"

namespace triad {
namespace {

void require_different(const std::vector<ErrorSubject>& all, const std::string& what) {
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (all[i].name == all[j].name)
                throw Error(Exit::usage, "Two " + what + " are called " + all[i].name +
                                             "; give one another name: \"NAME: ...\".");
}

ErrorPlan with_reference(ErrorPlan plan) {
    if (plan.reference_spp == 0) plan.reference_spp = std::max<std::uint64_t>(1024, 8 * plan.spp);
    return plan;
}

/// False: interrupted.
bool run_scene(const ErrorExperiment& e, std::size_t place, const ErrorBenchHost& host, ErrorBench& bench) {
    inform("Scene " + e.scenes[place].name);
    const Scene scene = e.load(place);
    std::vector<ErrorCase> cases;
    for (std::size_t setting = 0; setting < e.settings.size(); ++setting) {
        cases.push_back(e.prepare(place, setting, scene));
        cases.back().setting = bench.settings[setting];
        cases.back().device = &e.device(setting);
    }
    ErrorScene described;
    described.name = e.scenes[place].name, described.options = e.scenes[place].options;
    described.scene_hash = hash_of(scene);
    return run_errors(with_reference(e.plan), described, scene, std::move(cases), host, bench);
}

}  // namespace

void require_different_names(const ErrorExperiment& experiment) {
    require_different(experiment.scenes, "scenes");
    require_different(experiment.settings, "settings");
}

ErrorBench run_experiment(const ErrorExperiment& e, const ErrorBenchHost& host) {
    require_different_names(e);
    ErrorBench bench;
    bench.repetitions = e.plan.repetitions;
    for (std::size_t setting = 0; setting < e.settings.size(); ++setting) {
        const DeviceInfo& device = e.device(setting).info();
        if (setting == 0) bench.device = device;
        bench.settings.push_back(
            {e.settings[setting].name, e.settings[setting].options, device.name, device.driver});
    }
    for (std::size_t scene = 0; scene < e.scenes.size() && !bench.interrupted; ++scene)
        bench.interrupted = !run_scene(e, scene, host, bench);
    fit_curves(bench);
    bench.changes = changes_of(e.before, bench.runs);
    return bench;
}

}  // namespace triad
