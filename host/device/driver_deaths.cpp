// What to do in the life after a driver's death.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/files.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "device/drivers.h"

namespace fs = std::filesystem;

namespace triad::opencl {
namespace {

constexpr const char* death_schema = "triad.died/1";
constexpr const char *compiling = "compiling", *running = "running";

/// PoCL's folder as it chooses it.
fs::path pocl_cache() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const std::string own = variable("POCL_CACHE_DIR"); !own.empty()) return own;
    if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty())
        return fs::path(xdg) / "pocl/kcache";
    if (const std::string home = variable("HOME"); !home.empty())
        return fs::path(home) / ".cache/pocl/kcache";
    return "/tmp/pocl/kcache";
}

struct PoclCache {
    std::optional<TemporaryFolder> temporary;
    std::string trouble;
};
PoclCache& pocl() {
    static PoclCache state;
    return state;
}

/// The note of a Peril of one device, as fields between tabs.
struct DeviceNote {
    std::string kind, platform, name, driver;
    std::string cache;  ///< that may be to blame; empty: only the driver may
    std::string did;

    std::string text() const {
        return kind + '\t' + platform + '\t' + name + '\t' + driver + '\t' + cache + '\t' + did;
    }
};

std::optional<DeviceNote> parse(const std::string& text) {
    std::istringstream stream(text);
    DeviceNote note;
    for (std::string* part : {&note.kind, &note.platform, &note.name, &note.driver, &note.cache, &note.did})
        if (!std::getline(stream, *part, '\t')) return {};
    return note;
}

std::string note_of(const char* kind, const DeviceInfo& device, const std::string& did) {
    const bool cache = is_pocl(device.platform) && !pocl().temporary;
    return DeviceNote{kind, device.platform, device.name, device.driver, cache ? pocl_cache().string() : "",
                      did}
        .text();
}

/// Why files cannot be made in `folder`; empty when they can.
std::string why_not_writable(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) return failed.message();
    std::string probe = (folder / "triad-XXXXXX").string();
    const int file = ::mkstemp(probe.data());
    if (file < 0) return std::strerror(errno);
    ::close(file);
    fs::remove(probe, failed);
    return {};
}

/// Why PoCL cannot use its cache; empty when it can.
std::string pocl_cache_fault(const fs::path& folder) {
    for (const Death& death : earlier_deaths())
        if (const auto note = parse(death.note); note && note->cache == folder)
            return "PoCL died of " + death.cause + " when it " + note->did + ". What it keeps in " +
                   folder.string() +
                   " may be damaged, or that disk full: this run uses a temporary folder. If that helps, "
                   "delete the folder, make room, or set POCL_CACHE_DIR to another.";
    const std::string why = why_not_writable(folder);
    if (why.empty()) return {};
    return "PoCL cannot keep compiled kernels in " + folder.string() + " (" + why +
           "): this run uses a temporary folder and compiles all of them. POCL_CACHE_DIR names another.";
}

void keep(const DeviceInfo& device, const std::string& why) {
    const fs::path path = kept_path(device, "died");
    if (path.empty()) return;
    const nlohmann::json json{{"schema", death_schema},
                              {"device", device.name},
                              {"driver", device.driver},
                              {"platform", device.platform},
                              {"why", why}};
    try {
        fs::create_directories(path.parent_path());
        write_file(path, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const std::exception& error) {
        detail(std::string("That the driver died is not kept: ") + error.what());
    }
}

struct DriverDeath {
    std::string why;
    bool of_compiling;
};

/// How this device's driver ended an earlier life of this process, if nothing but the driver is to blame.
std::optional<DriverDeath> death_of(const DeviceInfo& device) {
    for (const Death& death : earlier_deaths())
        if (const auto note = parse(death.note); note && note->cache.empty() &&
                                                 note->platform == device.platform &&
                                                 note->name == device.name && note->driver == device.driver)
            return DriverDeath{"Its driver died of " + death.cause + " when it " + note->did + ".",
                               note->kind == compiling};
    return {};
}

/// From another process, within a day.
std::string kept_reason(const DeviceInfo& device) {
    const fs::path path = kept_path(device, "died");
    std::ifstream file(path);
    if (path.empty() || !file || is_older_than_a_day(path)) return {};
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object() || json.value("schema", nlohmann::json()) != death_schema ||
        !json.contains("why") || !json["why"].is_string())
        return {};
    return json["why"].get<std::string>() +
           " It is tried again with another driver or version of Triad, after a day, or without " +
           path.string() + ".";
}

}  // namespace

bool is_pocl(const std::string& platform) { return platform == "Portable Computing Language"; }

std::string compiling_note(const DeviceInfo& device, const std::string& did) {
    return note_of(compiling, device, did);
}

std::string running_note(const DeviceInfo& device, const std::string& kernel) {
    return note_of(running, device, "ran " + kernel);
}

std::string why_left_out(const DeviceInfo& device) {
    const std::optional<DriverDeath> death = death_of(device);
    if (!death) return kept_reason(device);
    warn(device.name + " is left out. " + death->why);
    return death->why;
}

void keep_death(const DeviceInfo& device) {
    const std::optional<DriverDeath> death = death_of(device);
    if (death && death->of_compiling) keep(device, death->why);
}

void place_pocl_cache(const std::vector<Icd>& icds) {
    const bool installed = std::ranges::any_of(
        icds, [](const Icd& icd) { return (icd.name + icd.library).find("pocl") != std::string::npos; });
    if (!installed && earlier_deaths().empty()) return;
    pocl().trouble = pocl_cache_fault(pocl_cache());
    if (pocl().trouble.empty()) return;
    pocl().temporary.emplace();
    ::setenv("POCL_CACHE_DIR", pocl().temporary->path().c_str(), 1);
}

bool is_pocl_cache_full() {
    std::error_code failed;
    const fs::space_info disk = fs::space(pocl_cache(), failed);
    return !failed && !pocl().temporary && disk.available < (std::uintmax_t(16) << 20);
}

const std::string& pocl_cache_trouble() { return pocl().trouble; }

}  // namespace triad::opencl
