#include "triad/devices.h"

#include <map>

#include "api/guard.h"
#include "base/error.h"
#include "base/log.h"
#include "check/check.h"
#include "check/verdict.h"
#include "device/device.h"
#include "panel/panel.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"
#include "trace/tune.h"

namespace triad::api {
namespace {

CheckLevel level_named(const std::string& name) {
    static const std::map<std::string, CheckLevel> levels = {
        {"quick", CheckLevel::quick}, {"standard", CheckLevel::standard}, {"full", CheckLevel::full}};
    const auto level = levels.find(name);
    if (level == levels.end())
        throw triad::Error(Exit::usage,
                           "check(): there is no level '" + name + "'; there are quick, standard and full.");
    return level->second;
}

CheckResult shown(const triad::CheckResult& r) {
    return {r.name, r.value, r.bound, r.ok, r.failures, r.seconds};
}

}  // namespace

std::string version() { return TRIAD_VERSION; }

void set_verbosity(int level) {
    if (level < 0 || level > 2)
        throw Error(int(Exit::usage),
                    "set_verbosity(): expected 0, 1 or 2, not " + std::to_string(level) + ".");
    set_log_level(level);
}

std::vector<Device> devices() {
    return guarded([] {
        std::vector<Device> all;
        for (const DeviceInfo& d : list_devices().devices)
            all.push_back({d.index, d.name, d.platform, d.driver, d.type, d.compute_units, d.memory, d.usable,
                           d.preferred, d.why_unusable});
        return all;
    });
}

std::vector<Panel> panels() {
    return guarded([] {
        std::vector<Panel> all;
        for (const triad::Panel& panel : builtin_panels()) all.push_back({panel.name, panel.description});
        return all;
    });
}

std::vector<CheckResult> check(const std::string& selector, const std::string& level,
                               const std::vector<std::string>& ids,
                               const std::function<bool(const CheckResult&)>& report) {
    Callback callback;
    std::vector<CheckResult> rows = guarded([&] {
        const CheckLevel amount = level_named(level);
        const std::vector<CheckCase> cases = cases_of(amount, ids);
        triad::Device device = triad::Device::open({.selector = selector});
        ensure_tuned(device);
        std::vector<triad::CheckResult> results;
        std::vector<CheckResult> all;
        for (const CheckCase& each : cases) {
            results.push_back(run_case(device, each, amount));
            all.push_back(shown(results.back()));
            if (report && !callback([&] { return report(all.back()); })) return all;
        }
        const std::optional<Verdict> verdict = verdict_of(results);
        if (ids.empty() && verdict)
            keep_verdict(device.info(), format_of(device), *verdict, path_driver_of(device));
        return all;
    });
    callback.rethrow();
    return rows;
}

}  // namespace triad::api
