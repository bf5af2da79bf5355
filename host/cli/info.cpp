// triad info: what is in a scene or a film, before any device is asked.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/command_line.h"
#include "cli/info_contents.h"
#include "cli/info_film.h"
#include "cli/option_kinds.h"
#include "io/gltf_contents.h"
#include "io/io.h"
#include "pack/texture_levels.h"
#include "report/report.h"
#include "scene/scene.h"

namespace triad {
namespace {

/// What rendering will hold on the device, within some percent: the structs of kernels/types.h and what
/// measurement gave for the trees (bytes per triangle).
constexpr double tree_bytes_per_triangle = 90;
constexpr std::size_t bytes_per_instance = 256;

struct Sizes {
    std::size_t primitives = 0, unique_triangles = 0, triangles = 0, emissive_triangles = 0;
    std::uint64_t attribute_bytes = 0, texture_bytes = 0, level_bytes = 0, device_bytes = 0;
};

Sizes sizes_of(const Scene& scene) {
    Sizes s;
    auto triangles_of = [](const Mesh& mesh) {
        std::size_t n = 0;
        for (const Primitive& p : mesh.primitives) n += p.triangles.size();
        return n;
    };
    for (const Mesh& mesh : scene.meshes) {
        s.primitives += mesh.primitives.size();
        s.unique_triangles += triangles_of(mesh);
        for (const Primitive& p : mesh.primitives) s.attribute_bytes += bytes_of(p);
    }
    for (const MeshInstance& instance : scene.instances) {
        s.triangles += triangles_of(scene.meshes[instance.mesh]);
        for (const Primitive& p : scene.meshes[instance.mesh].primitives)
            if (scene.materials[p.material].emission != vec3(0.0f))
                s.emissive_triangles += p.triangles.size();
    }
    for (const Image& image : scene.images) s.texture_bytes += image.texels.size();
    s.level_bytes = level_bytes(scene);
    s.device_bytes = s.attribute_bytes + s.texture_bytes + s.level_bytes +
                     bytes_per_instance * scene.instances.size() +
                     static_cast<std::uint64_t>(tree_bytes_per_triangle * double(s.unique_triangles));
    return s;
}

Exit run(const std::string& path, int scene_index, bool strict, std::optional<unsigned> max_texture,
         const std::string& json) {
    const GltfContents contents = gltf_contents(path);
    if (json != "-") print(contents);
    GltfReport report;
    Scene scene =
        load_gltf(path, {.scene = scene_index, .strict = strict, .max_texture = max_texture}, &report);
    refuse_to_replace({json}, report.files);
    const std::size_t dropped = validate(scene);
    if (dropped)
        report.warnings.push_back(std::to_string(dropped) +
                                  " triangles have no area or no finite corners and are left out");
    const Sizes s = sizes_of(scene);
    const Bounds bounds = bounds_of(scene);
    if (json != "-") {
        std::printf("rendered\nmeshes      %zu with %zu primitives, placed %zu times\n", scene.meshes.size(),
                    s.primitives, scene.instances.size());
        std::printf("triangles   %zu in meshes, %zu as placed, %zu of them emit\n", s.unique_triangles,
                    s.triangles, s.emissive_triangles);
        std::printf("materials   %zu\n", scene.materials.size());
        std::printf("textures    %zu of %zu images, %s, and %s of levels\n", scene.textures.size(),
                    scene.images.size(), bytes_text(s.texture_bytes).c_str(),
                    bytes_text(s.level_bytes).c_str());
        for (const Image& image : scene.images)
            std::printf("            %ux%u, %u bits  %s\n", image.width, image.height, image.bits,
                        image.name.c_str());
        std::printf("cameras     %zu\n", scene.cameras.size());
        for (std::size_t i = 0; i < scene.cameras.size(); ++i)
            std::printf("            %zu \"%s\", %s\n", i, scene.cameras[i].name.c_str(),
                        scene.cameras[i].orthographic ? "orthographic" : "perspective");
        std::printf("lights      %zu punctual\n", scene.lights.size());
        if (scene.environment)
            std::printf("environment %ux%u, the image-based light of the scene\n", scene.environment->width,
                        scene.environment->height);
        if (!bounds.empty())
            std::printf("bounds      (%g, %g, %g) to (%g, %g, %g)\n", bounds.lo.x, bounds.lo.y, bounds.lo.z,
                        bounds.hi.x, bounds.hi.y, bounds.hi.z);
        std::printf("memory      about %s on the device, beside the film\n",
                    bytes_text(s.device_bytes).c_str());
        std::printf("faults      %zu\n", report.warnings.size());
        for (const std::string& warning : report.warnings) std::printf("            %s\n", warning.c_str());
    }
    if (json.empty()) return Exit::done;
    Json cameras = Json::array();
    for (const SceneCamera& camera : scene.cameras)
        cameras.push_back(
            {{"name", camera.name}, {"projection", camera.orthographic ? "orthographic" : "perspective"}});
    Json row = {{"file", path},
                {"hash", hash_of(scene)},
                {"scenes", report.scenes},
                {"nodes", report.nodes},
                {"meshes", scene.meshes.size()},
                {"primitives", s.primitives},
                {"instances", scene.instances.size()},
                {"triangles", s.unique_triangles},
                {"placed_triangles", s.triangles},
                {"emissive_triangles", s.emissive_triangles},
                {"materials", scene.materials.size()},
                {"textures", scene.textures.size()},
                {"images", scene.images.size()},
                {"texture_bytes", s.texture_bytes},
                {"level_bytes", s.level_bytes},
                {"cameras", cameras},
                {"lights", scene.lights.size()},
                {"environment",
                 scene.environment ? Json{scene.environment->width, scene.environment->height} : Json()},
                {"bounds", bounds.empty() ? Json()
                                          : Json{bounds.lo.x, bounds.lo.y, bounds.lo.z, bounds.hi.x,
                                                 bounds.hi.y, bounds.hi.z}},
                {"contents", to_json(contents)},
                {"extensions_used", report.extensions_used},
                {"extensions_required", report.extensions_required},
                {"device_bytes", s.device_bytes},
                {"faults", report.warnings}};
    write_report(json, "info", nullptr, Json::array({std::move(row)}));
    return Exit::done;
}

/// What is refused is told in the JSON, too. A file that is there is left as it is: it may be one that the
/// scene refers to, which nobody knows of a scene that cannot be read.
void tell_refusal(const std::string& path, const Error& error, const std::string& json) {
    std::error_code none;
    if (json.empty() || (json != "-" && std::filesystem::exists(json, none))) return;
    write_report(json, "info", nullptr,
                 Json::array({{{"file", path}, {"error", error.what()}, {"exit", int(error.exit())}}}));
}

}  // namespace

void add_info(CLI::App& app, Exit& exit) {
    struct Options {
        std::string path, json;
        int scene = -1;
        bool strict = false;
        std::optional<unsigned> max_texture;
    };
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("info", "Show what is in a scene or a film, and its faults");
    command->add_option("SCENE|FILM", o->path, "glTF file, .gltf or .glb; or a film of triad render")
        ->required()
        ->type_name("");
    command->add_option("--scene", o->scene, "Which scene of the file (default: the one it names)")
        ->check(whole_number_within(0, 0x7fffffff))
        ->type_name("N");
    add_max_texture(*command, o->max_texture);
    command->add_flag("--strict", o->strict,
                      "Damaged data of the scene (images, normals and the like) are exit code 2");
    add_json(*command, o->json, "Write it");
    command->callback([o, &exit] {
        check_outputs({o->json}, {is_folder(o->path) ? "" : o->path});
        try {
            refuse_folder(o->path);
            exit = is_film(o->path) ? info_film(o->path, o->json)
                                    : run(o->path, o->scene, o->strict, o->max_texture, o->json);
        } catch (const Error& error) {
            tell_refusal(o->path, error, o->json);
            throw;
        }
    });
}

}  // namespace triad
