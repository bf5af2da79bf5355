#include "base/check_outputs.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/files.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

/// Devices and pipes: written to, not replaced.
bool is_special(const std::string& path) {
    std::error_code failed;
    const fs::file_status there = fs::status(path, failed);
    return path != "-" && fs::exists(there) && !fs::is_regular_file(there);
}

/// Whether a file that is there is `input`, or in a folder of that name.
bool is_within(const std::string& path, const std::string& input) {
    std::error_code failed;
    if (path == "-" || !fs::is_regular_file(path, failed)) return false;
    if (fs::equivalent(path, input, failed)) return true;
    if (!fs::is_directory(input, failed)) return false;
    for (fs::path folder = fs::canonical(path, failed).parent_path(); folder.has_relative_path();
         folder = folder.parent_path())
        if (fs::equivalent(folder, input, failed)) return true;
    return false;
}

void check_writable(const std::string& path) {
    if (path == "-") return;
    remove_leftovers(path, false);
    if (is_folder(path)) throw Error(Exit::scene, "Cannot write " + path + ": it is a folder.");
    // What writing will do: make a file beside it. Only the attempt tells; access rights are not the whole
    // story.
    const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
    if (!is_folder(folder))
        throw Error(Exit::scene, "Cannot write " + path + ": there is no folder " + folder.string() + ".");
    if (is_special(path)) return;
    const fs::path probe = folder / (".triad-probe" + fs::path(path).filename().string());
    const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) throw Error(Exit::scene, "Cannot write " + path + ": " + std::strerror(errno) + ".");
    ::close(file);
    std::error_code ignored;
    fs::remove(probe, ignored);
}

}  // namespace

void refuse_folder(const std::string& scene) {
    if (is_folder(scene))
        throw Error(Exit::scene, scene + " is a folder, not a scene; name a .gltf or .glb file.");
}

void refuse_to_replace(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    for (const std::string& path : outputs)
        for (const std::string& input : inputs)
            if (is_within(path, input))
                throw Error(Exit::usage, "The output " + path + " would replace " +
                                             (is_folder(input) ? "a file of " : "") + input +
                                             ", which is read; name another file.");
}

void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    std::set<fs::path> named;
    for (const std::string& path : outputs) {
        if (path.empty() || is_special(path)) continue;
        std::error_code failed;
        if (!named.insert(path == "-" ? fs::path(path) : fs::weakly_canonical(fs::absolute(path), failed))
                 .second)
            throw Error(Exit::usage, path == "-" ? "Only one of the outputs can go to standard output."
                                                 : "Two outputs are the same file, " + path + ".");
    }
    refuse_to_replace(outputs, inputs);
    for (const std::string& path : outputs)
        if (!path.empty()) check_writable(path);
}

void check_output_folder(const std::string& folder, const std::vector<std::string>& files,
                         const std::vector<std::string>& inputs) {
    if (folder.empty()) return;
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) throw Error(Exit::scene, "Cannot make the folder " + folder + ": " + failed.message() + ".");
    std::vector<std::string> paths;
    for (const std::string& file : files) paths.push_back(fs::path(folder) / file);
    check_outputs(paths, inputs);
}

}  // namespace triad
