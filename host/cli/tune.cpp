// triad tune: what suits this device and driver, by measurement.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "base/check_outputs.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "report/report.h"
#include "trace/tune.h"

namespace triad {
namespace {

struct TuneOptions {
    std::string device, json, kernels;
    unsigned threads = 0;
};

Exit run(const TuneOptions& o) {
    check_outputs({o.json}, {o.kernels});
    if (!o.kernels.empty()) kernel_source::set_folder(o.kernels);
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    const std::vector<TuneTiming> timings = tune(device);
    const Tuning best = best_of(timings);
    const bool lines = o.json != "-";
    if (lines)
        std::printf("%s, %s, driver %s\n", device.info().name.c_str(), device.info().platform.c_str(),
                    device.info().driver.c_str());
    Json rows = Json::array();
    for (const TuneTiming& timing : timings) {
        const bool chosen =
            std::includes(best.begin(), best.end(), timing.values.begin(), timing.values.end());
        if (lines)
            std::printf("%c %-8s %-32s %10.3f ms\n", chosen ? '*' : ' ', timing.search.c_str(),
                        text_of(timing.values).c_str(), 1e3 * timing.seconds);
        Json row{{"search", timing.search}, {"seconds", timing.seconds}, {"chosen", chosen}};
        for (const auto& [name, value] : timing.values) row[name] = value;
        rows.push_back(row);
    }
    if (lines)
        std::printf(
            "* what is used from now on; the first of a search unless another takes 5 %% less time\n");
    if (!o.json.empty()) write_report(o.json, "tune", &device.info(), rows);
    return Exit::done;
}

}  // namespace

void add_tune(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<TuneOptions>();
    CLI::App* command = app.add_subcommand(
        "tune",
        "Measure which nodes, work-group size and driver of paths suit a device, and keep it for later runs");
    add_device(*command, o->device);
    add_threads(*command, o->threads);
    add_json(*command, o->json, "Write the timings");
    add_kernels(*command, o->kernels);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
