#include "kept_options.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "../generated_scenes.h"
#include "../unit/test_assets.h"
#include "cli/experiment.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

const fs::path& hard_scenes() {
    static const fs::path folder = hard::generated("");
    return folder;
}

}  // namespace

bool renewing() { return std::getenv("TRIAD_RENEW") != nullptr; }

std::string with_folders(const std::string& options) {
    std::string text = options;
    const auto replace = [&](const std::string& name, const auto& folder) {
        for (std::size_t at; (at = text.find(name)) != std::string::npos;)
            text.replace(at, name.size(), "'" + fs::path(folder()).string() + "'");
    };
    replace("$SCENES", [] { return TRIAD_SCENES; });
    replace("$ODDS", [] { return TRIAD_SOURCE_DIR "/tests/image/odds.gltf"; });
    replace("$LOBES", [] { return TRIAD_SOURCE_DIR "/tests/image/lobes.gltf"; });
    replace("$ASSETS", test_assets);
    replace("$HARD", hard_scenes);
    return text;
}

RenderRequest scene_options(const std::string& name, const std::string& options) {
    std::string text = with_folders(options);
    std::erase(text, '\'');
    std::istringstream words(text);
    NamedOptions scene{name, {}};
    for (std::string word; words >> word;) {
        if (word == "--spp" || word == "--adaptive")
            words >> word;
        else
            scene.arguments.push_back(word);
    }
    return render_options({}, scene, {});
}

std::optional<std::string> why_not(const std::string& options) {
    if (options.find("$ASSETS") != std::string::npos && !fs::exists(test_assets()))
        return "There are no test models at " + test_assets().string() +
               "; TRIAD_TEST_ASSETS names another folder.";
    if (options.find("$HARD") != std::string::npos && !hard::why_no_scenes().empty())
        return hard::why_no_scenes();
    return {};
}

}  // namespace triad
