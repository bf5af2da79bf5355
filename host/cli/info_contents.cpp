#include "cli/info_contents.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "io/gltf_extensions.h"

namespace triad {
namespace {

using Json = nlohmann::ordered_json;

/// An extension of the file and what becomes of it.
struct Use {
    std::string name, what, how;
    bool required = false;
};

std::vector<Use> uses_of(const GltfContents& c) {
    std::vector<std::string> names = c.extensions_used;
    names.insert(names.end(), c.extensions_required.begin(), c.extensions_required.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<Use> uses;
    for (const std::string& name : names) {
        const bool required =
            std::count(c.extensions_required.begin(), c.extensions_required.end(), name) > 0;
        Use use{name, words_for(treatment_of(name), required), "", required};
        for (const GltfExtension& known : gltf_extensions())
            if (name == known.name && use.what != "refused") use.how = known.how;
        uses.push_back(std::move(use));
    }
    return uses;
}

}  // namespace

void print(const GltfContents& c) {
    std::printf(
        "in the file %zu scenes, %zu nodes, %zu meshes placed %zu times, %zu triangles, %zu materials\n",
        c.scenes, c.nodes, c.meshes, c.instances, c.triangles, c.materials);
    std::printf("            %zu textures of %zu images, %zu cameras, %zu lights, %zu morph targets\n",
                c.textures, c.images, c.cameras, c.lights, c.morph_targets);
    std::string primitives;
    for (const auto& [mode, count] : c.primitives)
        primitives += (primitives.empty() ? "" : ", ") + std::to_string(count) + " of " + mode;
    if (!primitives.empty()) std::printf("primitives  %s\n", primitives.c_str());
    if (!c.animations.empty()) std::printf("animations  %zu\n", c.animations.size());
    for (std::size_t i = 0; i < c.animations.size(); ++i)
        std::printf("            %zu \"%s\", %g s, %zu channels\n", i, c.animations[i].name.c_str(),
                    c.animations[i].seconds, c.animations[i].channels);
    if (!c.skins.empty()) std::printf("skins       %zu\n", c.skins.size());
    for (std::size_t i = 0; i < c.skins.size(); ++i)
        std::printf("            %zu \"%s\", %zu joints\n", i, c.skins[i].name.c_str(), c.skins[i].joints);
    if (!c.variants.empty()) std::printf("variants    %zu\n", c.variants.size());
    for (const std::string& variant : c.variants) std::printf("            \"%s\"\n", variant.c_str());
    const std::vector<Use> uses = uses_of(c);
    if (!uses.empty()) std::printf("extensions  %zu\n", uses.size());
    for (const Use& use : uses)
        std::printf("            %s%s: %s%s%s\n", use.name.c_str(), use.required ? " (required)" : "",
                    use.what.c_str(), use.how.empty() ? "" : "; ", use.how.c_str());
}

Json to_json(const GltfContents& c) {
    Json animations = Json::array(), skins = Json::array(), extensions = Json::array();
    for (const GltfContents::Animation& a : c.animations)
        animations.push_back({{"name", a.name}, {"seconds", a.seconds}, {"channels", a.channels}});
    for (const GltfContents::Skin& s : c.skins) skins.push_back({{"name", s.name}, {"joints", s.joints}});
    for (const Use& use : uses_of(c))
        extensions.push_back(
            {{"name", use.name}, {"required", use.required}, {"treatment", use.what}, {"how", use.how}});
    return {{"scenes", c.scenes},
            {"nodes", c.nodes},
            {"meshes", c.meshes},
            {"instances", c.instances},
            {"triangles", c.triangles},
            {"primitives", c.primitives},
            {"morph_targets", c.morph_targets},
            {"materials", c.materials},
            {"textures", c.textures},
            {"images", c.images},
            {"cameras", c.cameras},
            {"lights", c.lights},
            {"animations", std::move(animations)},
            {"skins", std::move(skins)},
            {"variants", c.variants},
            {"extensions", std::move(extensions)}};
}

}  // namespace triad
