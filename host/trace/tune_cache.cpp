/// What tune() keeps: one file per device, driver and kernels, so that two processes never edit the same
/// file.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/log.h"
#include "trace/tune.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* schema = "triad.tuned/2";

/// Those of searches that are still there and have values of all their axes of today that these know.
std::vector<TuneTiming> still_known(const std::vector<TuneTiming>& timings) {
    std::vector<TuneTiming> known;
    for (const TuneSearch& search : tune_searches())
        for (const TuneTiming& timing : timings)
            if (timing.search == search.name &&
                std::all_of(search.axes.begin(), search.axes.end(), [&](const TuneAxis& axis) {
                    const auto value = timing.values.find(axis.name);
                    return value != timing.values.end() && axis.knows(value->second);
                }))
                known.push_back(timing);
    return known;
}

bool has_first_use(const std::vector<TuneTiming>& timings) {
    return std::all_of(tune_searches().begin(), tune_searches().end(), [&](const TuneSearch& search) {
        return search.when != TuneWhen::first_use ||
               std::any_of(timings.begin(), timings.end(),
                           [&](const TuneTiming& timing) { return timing.search == search.name; });
    });
}

}  // namespace

std::optional<std::vector<TuneTiming>> load_timings(const DeviceInfo& device) {
    const fs::path path = kept_path(device, "tuned");
    std::ifstream file(path);
    if (path.empty() || !file) return {};
    try {
        const nlohmann::json json = nlohmann::json::parse(file);
        if (json.at("schema") != schema) return {};
        std::vector<TuneTiming> timings;
        for (const auto& row : json.at("timings"))
            timings.push_back({row.at("search"), row.at("values"), row.at("seconds")});
        timings = still_known(timings);
        if (has_first_use(timings)) return timings;
    } catch (const nlohmann::json::exception&) {  // damaged: measured again
    }
    return {};
}

void keep_timings(const DeviceInfo& device, const std::vector<TuneTiming>& timings) {
    const fs::path path = kept_path(device, "tuned");
    if (path.empty()) return;
    nlohmann::json json{{"schema", schema},
                        {"device", device.name},
                        {"driver", device.driver},
                        {"platform", device.platform},
                        {"timings", nlohmann::json::array()}};
    for (const TuneTiming& timing : timings)
        json["timings"].push_back(
            {{"search", timing.search}, {"values", timing.values}, {"seconds", timing.seconds}});
    try {
        fs::create_directories(path.parent_path());
        write_file(path, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const std::exception& error) {
        warn(std::string("What was tuned is not kept: ") + error.what());
    }
}

}  // namespace triad
