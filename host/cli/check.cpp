// triad check: is this device right? Known answers through the real kernels.
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/check_outputs.h"
#include "base/child.h"
#include "base/log.h"
#include "check/check.h"
#include "check/verdict.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "report/report.h"
#include "trace/node_format.h"
#include "trace/tune.h"

namespace triad {
namespace {

struct CheckOptions {
    std::string device, json, kernels;
    std::vector<std::string> only;
    unsigned threads = 0;
    std::optional<BvhFormat> format;
    std::optional<PathDriverKind> path_driver;
    CheckLevel level = CheckLevel::standard;
    bool first = false, list = false;
};

/// Every id that --case takes. Asks no device.
Exit print_cases(const CheckOptions& o) {
    if (!o.json.empty())
        throw Error(Exit::usage, "--list prints the cases and checks nothing: leave --json out.");
    for (const CheckCase& each : cases_of(CheckLevel::full)) std::printf("%s\n", each.name().c_str());
    return Exit::done;
}

void print(const CheckResult& r) {
    if (!r.ok)
        std::printf("%-62s %10s %10s  not applicable\n", r.name.c_str(), "", "");
    else
        std::printf("%-62s %10.3g %10.3g  %s\n", r.name.c_str(), r.value, r.bound,
                    *r.ok             ? "ok"
                    : r.lacked_memory ? "no memory"
                                      : "WRONG");
    for (const std::string& failure : r.failures) std::printf("    %s\n", failure.c_str());
    std::fflush(stdout);
    detail(r.name + ": " + std::to_string(r.seconds) + " s" + (r.what.empty() ? "" : "; " + r.what));
}

Exit run(const CheckOptions& o) {
    if (o.first) end_with_parent();
    check_outputs({o.json}, {o.kernels});
    if (!o.kernels.empty()) kernel_source::set_folder(o.kernels);
    const std::vector<CheckCase> cases = o.first ? first_cases() : cases_of(o.level, o.only);
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    if (o.level == CheckLevel::tiny) {  // measures nothing: for simulators
        set_format(device, o.format.value_or(default_format(device.info())));
        set_path_driver(device, o.path_driver.value_or(default_path_driver(device.info())));
    } else {
        Tuning wishes;
        if (o.format) wishes["format"] = name_of(*o.format);
        if (o.path_driver) wishes["path_driver"] = name_of(*o.path_driver);
        ensure_tuned(device, wishes);
    }
    const BvhFormat format = format_of(device);
    const PathDriverKind path_driver = path_driver_of(device);
    const bool lines = o.json != "-";
    if (lines) {
        std::printf("%s, %s, driver %s\n", device.info().name.c_str(), device.info().platform.c_str(),
                    device.info().driver.c_str());
        for (const std::string& setting : device.info().settings) std::printf("%s\n", setting.c_str());
        std::printf("nodes: %s, paths by: %s\n", name_of(format), name_of(path_driver));
        std::printf("%-62s %10s %10s\n", "case", "value", "bound");
    }
    std::vector<CheckResult> results = run_cases(device, cases, o.level, [&](const CheckResult& r) {
        if (lines) print(r);
    });
    Json rows = Json::array();
    std::size_t wrong = 0, absent = 0, lacking = 0;
    for (const CheckResult& r : results) {
        const bool answered = r.ok && !r.lacked_memory;
        wrong += answered && !*r.ok, absent += !r.ok, lacking += r.lacked_memory;
        rows.push_back({{"case", r.name},
                        {"format", name_of(format)},
                        {"path_driver", name_of(path_driver)},
                        {"value", answered && std::isfinite(r.value) ? Json(r.value) : Json()},
                        {"bound", answered ? Json(r.bound) : Json()},
                        {"ok", answered ? Json(*r.ok) : Json()},
                        {"what", r.what},
                        {"failures", r.failures},
                        {"seconds", r.seconds}});
    }
    if (!o.json.empty()) write_report(o.json, "check", &device.info(), rows);
    const std::optional<Verdict> verdict = verdict_of(results);
    if (o.only.empty() && o.level != CheckLevel::tiny && verdict)
        keep_verdict(device.info(), format, *verdict, path_driver);
    const std::string counts = std::to_string(results.size() - wrong - absent - lacking) + " right, " +
                               std::to_string(wrong) + " wrong, " + std::to_string(absent) +
                               " not applicable" +
                               (lacking ? ", " + std::to_string(lacking) + " without memory" : "");
    if (wrong + lacking > 0)
        throw Error(wrong ? Exit::device : Exit::memory,
                    device.info().name + " with driver " + device.info().driver +
                        (wrong ? " is wrong: " : " has too little memory: ") + counts + ".");
    if (lines) std::printf("%s\n", counts.c_str());
    return Exit::done;
}

}  // namespace

void add_check(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand("check", "Prove a device and its driver by known answers");
    add_device(*command, o->device);
    add_threads(*command, o->threads);
    add_format(*command, o->format);
    add_path_driver(*command, o->path_driver);
    std::vector<CLI::Option*> levels;
    const auto at = [&](const char* name, CheckLevel value, const char* words) {
        CLI::Option* level = command->add_flag_callback(
            name, [o, value] { o->level = value; }, words);
        for (CLI::Option* other : levels) level->excludes(other);
        levels.push_back(level);
    };
    at("--quick", CheckLevel::quick, "About 10 s instead of a minute");
    at("--full", CheckLevel::full, "Every case with all its work");
    at("--tiny", CheckLevel::tiny, "The quick cases with a thousandth of the work: for simulators");
    levels.push_back(command->add_flag_callback(
        "--first", [o] { o->first = true, o->level = CheckLevel::quick; },
        "Those of the quick cases that a new device answers for its first picture"));
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) levels.back()->excludes(levels[i]);
    command->add_option("--case", o->only, "Only the cases of these ids, like C1 or D4; --list prints them")
        ->delimiter(',')
        ->type_name("ID[,...]")
        ->excludes(levels.back());
    command->add_flag("--list", o->list, "Print the cases, each with what it asks, and end");
    add_json(*command, o->json);
    add_kernels(*command, o->kernels);
    command->callback([o, &exit] { exit = o->list ? print_cases(*o) : run(*o); });
}

}  // namespace triad
