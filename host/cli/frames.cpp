#include "cli/frames.h"

#include <filesystem>

#include "base/files.h"
#include "base/text.h"
#include "cli/resume.h"

namespace fs = std::filesystem;

namespace triad {

std::string numbered(const std::string& path, std::uint64_t frame) {
    if (path.empty()) return path;
    fs::path named(path);
    const std::string extension = named.extension().string();
    return named.replace_extension(format(".%04llu", static_cast<unsigned long long>(frame)) + extension)
        .string();
}

RenderRequest frame_of(const RenderRequest& all, std::uint64_t frame) {
    RenderRequest one = all;
    one.frames.reset();
    one.pose_time = double(frame) / all.fps;
    one.words.push_back("--pose-time=" + format("%.17g", one.pose_time));
    if (one.outputs.empty() && one.film_path.empty() && one.resume_path.empty())
        one.outputs = {default_output};
    for (std::string& path : one.outputs) path = numbered(path, frame);
    for (std::string* path : {&one.film_path, &one.resume_path, &one.json_path})
        *path = numbered(*path, frame);
    if (!is_there(one.resume_path)) {  // it was not begun
        if (one.film_path.empty()) one.film_path = one.resume_path;
        one.resume_path.clear();
    }
    return one;
}

std::string command_that_goes_on(const CLI::App& command, const RenderRequest& all, std::uint64_t frame) {
    const std::string film = all.film_path.empty() ? all.resume_path : all.film_path;
    return command_of(command, {"--frames", "--film", "--resume"},
                      {"--frames=" + std::to_string(frame) + ":" + std::to_string(all.frames->end),
                       film.empty() ? "" : "--resume=" + film});
}

}  // namespace triad
