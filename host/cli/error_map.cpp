#include "cli/error_map.h"

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "report/error_pictures.h"
#include "session/output.h"

namespace triad {

void check_error_map(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension != ".exr" && extension != ".png")
        throw Error(Exit::usage, "--map " + path + ": the extension must be .exr or .png.");
}

void write_error_map(const std::string& path, unsigned width, unsigned height,
                     const std::vector<float>& error, const std::vector<Channel>& parts,
                     const Metadata& metadata) {
    if (!is_exr(path)) {
        const auto bytes = false_colour_map_png(error, width, height, {0, round_limit({&error}), false});
        write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        return;
    }
    Picture picture{width, height, 0, 0, 0, 0, {{"error", error}}, metadata};
    picture.channels.insert(picture.channels.end(), parts.begin(), parts.end());
    write_exr(path, picture);
}

}  // namespace triad
