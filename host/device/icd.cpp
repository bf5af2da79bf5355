#include "device/icd.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include "base/files.h"
#include "base/hash.h"

extern char** environ;

namespace fs = std::filesystem;

namespace triad::opencl {
namespace {

constexpr const char* vendors = "OCL_ICD_VENDORS";
constexpr const char* filenames = "OCL_ICD_FILENAMES";

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

std::string library_in(const fs::path& file) {
    std::ifstream text(file);
    std::string line;
    std::getline(text, line);
    return line;
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ':');)
        if (!part.empty()) parts.push_back(part);
    return parts;
}

/// Size and time of a file, or that there is none.
void add_state(Hash& key, const fs::path& path) {
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    key.add(path.string()).add_value<std::int64_t>(exists ? status.st_size : -1);
    key.add_value<std::int64_t>(status.st_mtim.tv_sec).add_value<std::int64_t>(status.st_mtim.tv_nsec);
}

/// What loaders and drivers read of the environment, by the beginnings of the names.
bool concerns_drivers(std::string_view entry) {
    if (entry.starts_with("POCL_CACHE_DIR=")) return false;  // Triad sets it
    static constexpr std::array<std::string_view, 19> beginnings = {
        "OCL_",    "OPENCL_", "LD_",   "CL_",  "POCL_", "RUSTICL_", "MESA_", "GALLIUM_",  "LP_",    "CUDA_",
        "NVIDIA_", "HSA_",    "ROCR_", "AMD_", "GPU_",  "ZE_",      "NEO",   "OCLGRIND_", "LIBCLC_"};
    return std::ranges::any_of(beginnings, [&](std::string_view each) { return entry.starts_with(each); });
}

}  // namespace

std::vector<Icd> installed_icds() {
    std::vector<Icd> icds;
    const auto add_file = [&](const fs::path& file) {
        icds.push_back({file.filename().string(), file, library_in(file)});
    };
    std::string folder = variable("OPENCL_VENDOR_PATH");
    if (folder.empty()) folder = "/etc/OpenCL/vendors";
    const std::string chosen = variable(vendors);
    std::error_code none;
    if (chosen.empty() || fs::is_directory(chosen, none)) {
        for (const auto& entry : fs::directory_iterator(chosen.empty() ? folder : chosen, none))
            if (entry.path().string().ends_with(".icd")) add_file(entry.path());
    } else if (chosen.ends_with(".icd")) {
        const fs::path listed = fs::path(folder) / chosen;
        add_file(chosen.find('/') == std::string::npos && fs::exists(listed, none) ? listed
                                                                                   : fs::path(chosen));
    } else {
        icds.push_back({fs::path(chosen).filename().string(), {}, chosen});
    }
    std::ranges::sort(icds, {}, &Icd::name);
    for (const std::string& library : split(variable(filenames)))
        icds.push_back({fs::path(library).filename().string(), {}, library, true});
    return icds;
}

std::string key_of(const std::vector<Icd>& icds) {
    Hash key;
    key.add("1");  // the format
    std::array<char, 256> machine{};
    ::gethostname(machine.data(), machine.size() - 1);
    key.add(machine.data());
    // A library found by its bare name lies where the linker's cache or LD_LIBRARY_PATH says.
    add_state(key, "/etc/ld.so.cache");
    const std::vector<std::string> folders = split(variable("LD_LIBRARY_PATH"));
    for (const Icd& icd : icds) {
        key.add(icd.name).add(icd.library);
        if (!icd.file.empty()) add_state(key, icd.file);
        if (icd.library.find('/') != std::string::npos)
            add_state(key, icd.library);
        else
            for (const std::string& folder : folders) add_state(key, fs::path(folder) / icd.library);
    }
    std::vector<std::string_view> entries;
    for (char** entry = environ; *entry; ++entry)
        if (concerns_drivers(*entry)) entries.emplace_back(*entry);
    std::ranges::sort(entries);
    for (const std::string_view entry : entries) key.add(entry);
    return key.hex();
}

std::map<std::string, std::string> environment_for(const std::vector<Icd>& icds, const fs::path& folder) {
    std::string extra;
    std::size_t count = 0;
    for (const Icd& icd : icds) {
        if (icd.extra)
            extra += (extra.empty() ? "" : ":") + icd.library;
        else  // numbered: loaders take any name, and two libraries may share theirs
            write_file(folder / (std::to_string(count++) + "-" + icd.name + ".icd"), icd.library + "\n");
    }
    return {{vendors, folder.string()}, {filenames, extra}};
}

}  // namespace triad::opencl
