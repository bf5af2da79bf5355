#include "bench/profile_run.h"

#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

/// For a map of time that is nice to have.
constexpr double most_seconds_of_tiles = 20;

}  // namespace

Profile profile_runs(Renderer& renderer, const RenderGoal& goal, std::uint32_t seed, unsigned runs,
                     const std::function<bool(unsigned, unsigned)>& report) {
    Device& device = renderer.device();
    Profile p;
    p.device = device.info();
    p.format = name_of(format_of(device)), p.path_driver = name_of(path_driver_of(device));
    std::vector<std::vector<DeviceCommand>> commands;
    for (unsigned run = 0; run <= runs; ++run) {
        renderer.restart(seed + run);
        const std::size_t before = device.commands().size();
        const RenderResult result = renderer.render_until(goal, [](const Progress&) { return true; });
        renderer.film();
        const std::vector<DeviceCommand>& all = device.commands();
        if (run > 0) {  // the first warmed up
            commands.emplace_back(all.begin() + std::ptrdiff_t(before), all.end());
            p.seconds_of_runs.push_back(result.seconds);
            p.samples = double(renderer.film().sample_numbers().total);
        }
        if (!report(run, runs)) break;
    }
    if (commands.empty())
        throw Error(Exit::interrupted, "The profile was stopped before its first run ended.");
    p.memory = renderer.device_memory();
    p.compilations = device.compilations();
    add_commands(p, commands, device.kernels());
    return p;
}

Profile profile(Renderer& renderer, const RenderGoal& goal, std::uint32_t seed, unsigned runs,
                const std::function<bool(unsigned, unsigned)>& report) {
    Profile p = profile_runs(renderer, goal, seed, runs, report);
    renderer.restart(seed);
    const WorkCounts counts = renderer.count_work(counted_samples);
    p.tile_seconds = renderer.time_tiles(counted_samples, most_seconds_of_tiles);
    add_costs(p, counts, peaks_of(renderer.device()));
    return p;
}

}  // namespace triad
