#include "render/kept_pilot.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/log.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* schema = "triad.pilot/1";

/// A new build may choose otherwise.
std::string this_build() {
    std::error_code error;
    const auto written = fs::last_write_time(fs::read_symlink("/proc/self/exe", error), error);
    return TRIAD_VERSION " " + std::to_string(written.time_since_epoch().count());
}

fs::path path_of(const DeviceInfo& device, const std::string& about) {
    return kept_path(device, "pilots", this_build() + about);
}

}  // namespace

std::optional<PilotChoice> kept_pilot(const DeviceInfo& device, const std::string& about) {
    const fs::path path = path_of(device, about);
    std::ifstream file(path);
    if (path.empty() || !file) return {};
    try {
        const nlohmann::json json = nlohmann::json::parse(file);
        if (json.at("schema") != schema) return {};
        if (!json.at("photons").is_number_unsigned()) return {};
        const PilotChoice choice{json.at("paths"), json.at("photons")};
        if (choice.paths == (choice.photons == 0)) return choice;
    } catch (const nlohmann::json::exception&) {  // damaged: flown again
    }
    return {};
}

void keep_pilot(const DeviceInfo& device, const std::string& about, const PilotChoice& choice) {
    const fs::path path = path_of(device, about);
    if (path.empty()) return;
    const nlohmann::json json{{"schema", schema}, {"paths", choice.paths}, {"photons", choice.photons}};
    try {
        fs::create_directories(path.parent_path());
        write_file(path, json.dump() + "\n");
    } catch (const std::exception& error) {
        detail(std::string("What a pilot chose is not kept: ") + error.what());
    }
}

}  // namespace triad
