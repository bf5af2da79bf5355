#include "io/gltf_contents.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/gltf_file.h"

namespace triad {
namespace {

using nlohmann::json;

std::size_t size_of(const json& document, const char* list) {
    const auto found = document.find(list);
    return found == document.end() ? 0 : found->size();
}

/// The array at this place, or none.
const json& array_at(const json& object, const std::string& pointer) {
    static const json none = json::array();
    const json::json_pointer at(pointer);
    return object.contains(at) && object[at].is_array() ? object[at] : none;
}

std::string name_of(const json& object) {
    const auto name = object.find("name");
    return name != object.end() && name->is_string() ? name->get<std::string>() : std::string();
}

std::vector<std::string> texts(const json& list) { return list.get<std::vector<std::string>>(); }

std::size_t count_of(const json& document, const json& accessor) {
    return document["accessors"][accessor.get<std::size_t>()]["count"].get<std::size_t>();
}

std::size_t triangles_of(std::size_t corners, int mode) {
    if (mode < 4) return 0;
    return mode == 4 ? corners / 3 : corners < 3 ? 0 : corners - 2;
}

void add_meshes(const json& document, GltfContents& c) {
    static const char* const modes[] = {"points",    "lines",           "line loops",   "line strips",
                                        "triangles", "triangle strips", "triangle fans"};
    for (const json& mesh : array_at(document, "/meshes")) {
        std::size_t targets = 0;
        for (const json& primitive : mesh["primitives"]) {
            const int mode = primitive.value("mode", 4);
            ++c.primitives[modes[mode]];
            targets = std::max(targets, size_of(primitive, "targets"));
            const auto indices = primitive.find("indices"),
                       positions = primitive["attributes"].find("POSITION");
            if (indices != primitive.end())
                c.triangles += triangles_of(count_of(document, *indices), mode);
            else if (positions != primitive["attributes"].end())
                c.triangles += triangles_of(count_of(document, *positions), mode);
        }
        c.morph_targets += targets;
    }
}

void add_nodes(const json& document, GltfContents& c) {
    const json::json_pointer instancing("/extensions/EXT_mesh_gpu_instancing/attributes");
    for (const json& node : array_at(document, "/nodes")) {
        if (!node.contains("mesh")) continue;
        if (!node.contains(instancing))
            ++c.instances;
        else if (!node[instancing].empty())
            c.instances += count_of(document, *node[instancing].begin());
    }
}

void add_animations(const json& document, GltfContents& c) {
    for (const json& animation : array_at(document, "/animations")) {
        GltfContents::Animation a{name_of(animation), 0, animation["channels"].size()};
        for (const json& sampler : animation["samplers"]) {
            const json& input = document["accessors"][sampler["input"].get<std::size_t>()];
            const json& most = array_at(input, "/max");
            if (most.size() == 1 && most[0].is_number())
                a.seconds = std::max(a.seconds, most[0].get<double>());
        }
        c.animations.push_back(std::move(a));
    }
    for (const json& skin : array_at(document, "/skins"))
        c.skins.push_back({name_of(skin), skin["joints"].size()});
}

}  // namespace

GltfContents gltf_contents(const std::filesystem::path& path) {
    json document;
    try {
        document = gltf::read_document(path);
    } catch (const Error& e) {
        throw gltf::named(e, path);
    }
    GltfContents c;
    c.extensions_used = texts(array_at(document, "/extensionsUsed"));
    c.extensions_required = texts(array_at(document, "/extensionsRequired"));
    c.scenes = size_of(document, "scenes"), c.nodes = size_of(document, "nodes");
    c.meshes = size_of(document, "meshes"), c.materials = size_of(document, "materials");
    c.textures = size_of(document, "textures"), c.images = size_of(document, "images");
    c.cameras = size_of(document, "cameras");
    c.lights = array_at(document, "/extensions/KHR_lights_punctual/lights").size();
    for (const json& variant : array_at(document, "/extensions/KHR_materials_variants/variants"))
        c.variants.push_back(name_of(variant));
    add_meshes(document, c);
    add_nodes(document, c);
    add_animations(document, c);
    return c;
}

}  // namespace triad
