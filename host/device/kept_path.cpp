#include "base/files.h"
#include "base/hash.h"
#include "device/device.h"

namespace fs = std::filesystem;

namespace triad {

fs::path kept_path(const DeviceInfo& device, const std::string& folder, const std::string& about) {
    const fs::path cache = cache_folder();
    if (cache.empty()) return {};
    Hash key;
    for (const std::string& part : {device.platform, device.name, device.driver, kernel_source::hash()})
        key.add(part);
    for (const std::string& setting : device.settings) key.add(setting);
    if (!about.empty()) key.add(about);
    return cache / folder / (key.hex() + ".json");
}

}  // namespace triad
