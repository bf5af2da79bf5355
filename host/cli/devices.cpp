// triad devices: every platform and device, what each can do, why one is unusable, and what Triad would
// choose.
#include <cstdio>
#include <memory>

#include "base/check_outputs.h"
#include "base/text.h"
#include "check/verdict.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "device/device.h"
#include "report/report.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"
#include "trace/tune.h"

namespace triad {
namespace {

/// What was measured best; empty: nothing was.
Tuning tuned(const DeviceInfo& device) {
    const auto timings = load_timings(device);
    return timings ? best_of(*timings) : Tuning{};
}

/// Of the nodes that the device would walk, and the driver that it would follow paths by.
std::optional<Verdict> verdict_on(const DeviceInfo& device) {
    const Tuning tuning = tuned(device);
    const auto format = tuning.find("format"), driver = tuning.find("path_driver");
    return load_verdict(
        device, format == tuning.end() ? default_format(device) : *find_bvh_format(format->second),
        driver == tuning.end() ? default_path_driver(device) : *find_path_driver(driver->second));
}

/// The axes that were not measured, which have their preferred values.
std::string not_tuned(const DeviceInfo& device) {
    const Tuning tuning = tuned(device);
    std::string names;
    for (const TuneSearch& search : tune_searches())
        for (const TuneAxis& axis : search.axes)
            if (!tuning.contains(axis.name)) names += (names.empty() ? "" : ", ") + std::string(axis.name);
    return names;
}

void print(const DeviceList& list) {
    std::printf("  #  type  device\n");
    for (const DeviceInfo& d : list.devices) {
        std::printf("%c %2zu  %-4.4s  %s\n", d.preferred ? '*' : ' ', d.index, d.type.c_str(),
                    d.name.c_str());
        std::printf("           %s, %s, driver %s\n", d.platform.c_str(), d.c_version.c_str(),
                    d.driver.c_str());
        std::printf("           %u compute units, %s (%s at once), correctly rounded divide %s, double %s\n",
                    d.compute_units, bytes_text(d.memory).c_str(), bytes_text(d.max_allocation).c_str(),
                    d.correctly_rounded ? "yes" : "no", d.fp64 ? "yes" : "no");
        for (const std::string& setting : d.settings) std::printf("           %s\n", setting.c_str());
        if (d.usable) {
            const auto verdict = verdict_on(d);
            std::printf("           %s\n", !verdict                 ? "not checked yet (triad check)"
                                           : verdict->wrong.empty() ? "checked: right"
                                                                    : "checked: WRONG (triad check)");
            const std::string best = text_of(tuned(d)), rest = not_tuned(d);
            if (!best.empty()) std::printf("           tuned: %s\n", best.c_str());
            if (!rest.empty()) std::printf("           not tuned yet (triad tune): %s\n", rest.c_str());
        }
        if (!d.usable) std::printf("           UNUSABLE: %s\n", d.why_unusable.c_str());
    }
    for (const PlatformProblem& p : list.problems)
        std::printf("     platform %s: %s\n", p.platform.c_str(), p.why.c_str());
    std::printf("* what Triad chooses; --device takes a number, cpu, gpu, or part of a name\n");
}

Exit run(const std::string& json) {
    check_outputs({json}, {});
    const DeviceList list = list_devices();
    Json rows = Json::array();
    const DeviceInfo* chosen = nullptr;
    for (const DeviceInfo& device : list.devices) {
        rows.push_back(to_json(device));
        rows.back()["tuned"] = tuned(device);
        if (device.preferred) chosen = &device;
    }
    for (const PlatformProblem& problem : list.problems)
        rows.push_back({{"platform", problem.platform}, {"usable", false}, {"why_unusable", problem.why}});
    if (json != "-") print(list);
    if (!json.empty()) write_report(json, "devices", chosen, rows);
    if (!chosen)
        throw Error(Exit::device,
                    "There is no usable OpenCL device. On Debian: apt-get install pocl-opencl-icd makes the "
                    "CPU one.");
    return Exit::done;
}

}  // namespace

void add_devices(CLI::App& app, Exit& exit) {
    auto json = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("devices", "List OpenCL devices, what each can do, and which one is chosen");
    add_json(*command, *json, "Write the list");
    command->callback([json, &exit] { exit = run(*json); });
}

}  // namespace triad
