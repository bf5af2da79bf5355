/// What tune() keeps: one file per device, driver and kernels, so that two processes never edit the same
/// file.
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/log.h"
#include "trace/tune.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* schema = "triad.tuned/2";

/// Whether the timings are of today's searches and axes.
bool is_whole(const std::vector<TuneTiming>& timings) {
    for (const TuneSearch& search : tune_searches()) {
        bool any = false;
        for (const TuneTiming& timing : timings) {
            if (timing.search != search.name) continue;
            any = true;
            for (const TuneAxis& axis : search.axes)
                if (!timing.values.contains(axis.name)) return false;
        }
        if (!any) return false;
    }
    return true;
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
        if (is_whole(timings)) return timings;
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
