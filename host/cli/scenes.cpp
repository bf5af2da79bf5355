#include "cli/scenes.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/files.h"
#include "base/log.h"
#include "base/program.h"
#include "base/text.h"
#include "cli/resume.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

const std::string place = "%s";

/// Every scene writes files of its own.
void require_names(const RenderRequest& all, const std::vector<std::string>& scenes) {
    if (all.pixel)
        throw Error(Exit::usage,
                    "--pixel takes one scene, and here are " + std::to_string(scenes.size()) + ".");
    std::vector<std::string> paths = all.outputs;
    paths.insert(paths.end(), {all.film_path, all.resume_path, all.json_path});
    for (const std::string& path : paths)
        if (!path.empty() && path.find(place) == std::string::npos)
            throw Error(Exit::usage, path + ": of several scenes each has files of its own. Write " + place +
                                         " where the name of the scene belongs, like out/%s.png.");
    std::map<std::string, std::string> named;
    for (const std::string& scene : scenes)
        if (const auto [at, is_new] = named.emplace(named_for(place, scene), scene); !is_new)
            throw Error(Exit::usage, at->second + " and " + scene + " are both called " + at->first +
                                         ", so that their files would be one: render them apart.");
    if (all.frames) throw Error(Exit::usage, "--frames is of one scene.");
}

/// From this scene on: its film goes on, the others begin.
std::string command_from(const CLI::App& command, const RenderRequest& all,
                         std::vector<std::string> scenes_left) {
    const std::string film = all.film_path.empty() ? all.resume_path : all.film_path;
    if (!film.empty()) scenes_left.push_back("--resume=" + film);
    return command_of(command, {"", "--film", "--resume"}, scenes_left);
}

}  // namespace

std::string named_for(const std::string& path, const std::string& scene) {
    return CLI::detail::find_and_replace(path, place,
                                         scene.empty() ? "built-in" : fs::path(scene).stem().string());
}

RenderRequest scene_of(const RenderRequest& all, const std::string& scene) {
    RenderRequest one = all;
    one.scene_path = scene;
    std::erase_if(one.words, [](const std::string& word) { return !word.starts_with("--"); });
    if (!scene.empty()) one.words.insert(one.words.begin(), scene);
    for (std::string& path : one.outputs) path = named_for(path, scene);
    for (std::string* path : {&one.film_path, &one.resume_path, &one.json_path})
        *path = named_for(*path, scene);
    return one;
}

Exit for_each_scene(const CLI::App& command, const RenderRequest& all, const std::vector<std::string>& scenes,
                    const std::function<Exit(const RenderRequest&, const std::string&)>& render) {
    require_names(all, scenes);
    RenderRequest named = all;
    if (all.outputs.empty() && all.film_path.empty() && all.resume_path.empty()) named.outputs = {"%s.png"};
    RenderRequest checked = scene_of(named, scenes.front());
    complete(checked);  // what is wrong with all is said once
    int worst = 0;
    for (auto scene = scenes.begin(); scene != scenes.end(); ++scene) {
        RenderRequest one = scene_of(named, *scene);
        if (!one.resume_path.empty() && !is_there(one.resume_path)) {  // it was not begun
            if (one.film_path.empty()) one.film_path = one.resume_path;
            one.resume_path.clear();
        }
        inform(format("Scene %td of %zu: ", scene - scenes.begin() + 1, scenes.size()) + *scene);
        const int exit = exit_code_of("triad: " + *scene, [&] {
            return int(render(one, command_from(command, all, {scene, scenes.end()})));
        });
        worst = std::max(worst, exit);
        const bool is_last = scene + 1 == scenes.end();
        if (exit == int(Exit::interrupted)) break;
        if (exit == int(Exit::device) && !is_last) {
            warn("The scenes after it are not rendered: they would ask the same device.");
            break;
        }
    }
    return Exit(worst);
}

}  // namespace triad
