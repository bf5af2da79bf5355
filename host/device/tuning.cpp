#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "device/device.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* schema = "triad.tuned/1";

fs::path tuned_path(const DeviceInfo& device) { return kept_path(device, "tuned"); }

}  // namespace

// One file per device, driver and kernels, so that two processes never edit the same file.
fs::path kept_path(const DeviceInfo& device, const std::string& folder) {
    const fs::path cache = cache_folder();
    if (cache.empty()) return {};
    Hash key;
    for (const std::string& part : {device.platform, device.name, device.driver, kernel_source::hash()})
        key.add(part);
    for (const std::string& setting : device.settings) key.add(setting);
    return cache / folder / (key.hex() + ".json");
}

std::optional<std::size_t> load_tuned_local(const DeviceInfo& device) {
    const fs::path path = tuned_path(device);
    std::ifstream file(path);
    if (path.empty() || !file) return {};
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object() || !json.contains("local") || !json.contains("schema") || json["schema"] != schema)
        return {};
    const auto& local = json["local"];
    if (!local.is_number_unsigned() || local == 0u) return {};
    return local.get<std::size_t>();
}

void store_tuned_local(const DeviceInfo& device, std::size_t local) {
    const fs::path path = tuned_path(device);
    if (path.empty()) return;
    const nlohmann::json json{{"schema", schema},
                              {"device", device.name},
                              {"driver", device.driver},
                              {"platform", device.platform},
                              {"local", local}};
    try {
        fs::create_directories(path.parent_path());
        write_file(path, json.dump(1) + "\n");
    } catch (const std::exception& error) {
        warn(std::string("The tuned work-group size is not kept: ") + error.what());
    }
}

}  // namespace triad
