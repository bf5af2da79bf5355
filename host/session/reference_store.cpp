#include "session/reference_store.h"

#include <filesystem>

#include "base/files.h"
#include "base/log.h"
#include "io/io.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

fs::path path_of(const std::string& key) {
    const fs::path cache = cache_folder();
    return cache.empty() ? fs::path{} : cache / "references" / (key + ".film");
}

}  // namespace

std::optional<Film> load_reference(const std::string& key) {
    const fs::path path = path_of(key);
    std::error_code absent;
    if (path.empty() || !fs::exists(path, absent)) return {};
    try {
        return load_film(path);
    } catch (const std::exception& error) {
        warn(std::string("A kept reference is of no use and is rendered again: ") + error.what());
        return {};
    }
}

void keep_reference(const std::string& key, const Film& film) {
    const fs::path path = path_of(key);
    if (path.empty()) return;
    try {
        fs::create_directories(path.parent_path());
        save_film(path, film);
        detail("The reference is kept as " + path.string());
    } catch (const std::exception& error) {
        warn(std::string("The reference is not kept: ") + error.what());
    }
}

}  // namespace triad
