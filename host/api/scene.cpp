#include "triad/scene.h"

#include "api/guard.h"
#include "api/inside.h"
#include "api/parse.h"

namespace triad::api {
namespace {

std::shared_ptr<const Scene::Inside> read(RenderRequest request) {
    LoadedScene loaded = read_scene(request);
    return std::make_shared<const Scene::Inside>(Scene::Inside{std::move(request), std::move(loaded)});
}

template <class Things>
std::vector<std::string> names_of(const Things& things) {
    std::vector<std::string> names;
    for (const auto& thing : things) names.push_back(thing.name);
    return names;
}

}  // namespace

Scene::Scene() : inside_(guarded([] { return read({}); })) {}

Scene::Scene(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

std::string Scene::name() const {
    const std::string& path = inside().request.scene_path;
    return path.empty() ? "built-in" : std::filesystem::path(path).filename().string();
}

std::size_t Scene::triangles() const {
    std::size_t sum = 0;
    for (const triad::Mesh& mesh : inside().loaded.scene.meshes)
        for (const Primitive& primitive : mesh.primitives) sum += primitive.triangles.size();
    return sum;
}

std::size_t Scene::instances() const { return inside().loaded.scene.instances.size(); }

std::vector<std::string> Scene::materials() const { return names_of(inside().loaded.scene.materials); }

std::vector<std::string> Scene::cameras() const { return names_of(inside().loaded.scene.cameras); }

std::optional<std::array<double, 6>> Scene::bounds() const {
    const Bounds all = bounds_of(inside().loaded.scene);
    if (all.empty()) return {};
    return std::array{all.lo.x, all.lo.y, all.lo.z, all.hi.x, all.hi.y, all.hi.z};
}

std::vector<std::string> Scene::warnings() const { return inside().loaded.report.warnings; }

Scene load(const std::filesystem::path& path, const Options& options) {
    return guarded([&] {
        RenderRequest request;
        parse_load_options(options, request);
        request.scene_path = path.string();
        if (request.scene_path.empty())
            throw triad::Error(Exit::usage, "load(): the name of the file is empty.");
        request.words.push_back(request.scene_path);
        return Scene(read(std::move(request)));
    });
}

}  // namespace triad::api
