/// Nodes: where meshes, lights and cameras are.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>

#include "base/aligned_vector.h"
#include "base/error.h"
#include "base/freed_memory.h"
#include "io/gltf_animation.h"
#include "io/gltf_extras.h"
#include "io/gltf_image_light.h"
#include "io/gltf_instancing.h"
#include "io/gltf_material.h"
#include "io/gltf_mesh.h"
#include "io/gltf_pose.h"
#include "io/gltf_skin.h"
#include "io/gltf_variants.h"
#include "scene/scene.h"

namespace triad::gltf {
namespace {

class SceneBuilder {
  public:
    SceneBuilder(File& file, const GltfChoice& choice)
        : file_(file),
          choice_(choice),
          nodes_(file, pose_at(file, choose_animation(file, choice.animation), choice.time)),
          materials_(file, scene_),
          meshes_(file, scene_, materials_, find_variant(file, choice.variant)) {}

    Scene build() {
        const auto& scenes = file_.model.scenes;
        if (choice_.time != 0 && choose_animation(file_, choice_.animation) < 0)
            file_.warn("No animation moves the scene: --pose-time and --frames change nothing.");
        if (choice_.scene >= int(scenes.size()))
            throw Error(Exit::scene, "Scene " + std::to_string(choice_.scene) +
                                         " was asked for, but the file has " + std::to_string(scenes.size()) +
                                         ".");
        const int chosen = choice_.scene >= 0 ? choice_.scene : std::max(file_.model.defaultScene, 0);
        if (chosen < int(scenes.size())) {
            scene_.name = scenes[std::size_t(chosen)].name;
            scene_.instances.reserve(std::size_t(std::ranges::count_if(
                file_.nodes, [](const Node& node) { return node.mesh >= 0 && node.instancing.empty(); })));
            walk(scenes[std::size_t(chosen)].nodes);
        }
        materials_.decode_images(choice_.max_texture);
        if (choice_.image_light && chosen < int(scenes.size()))
            scene_.environment = image_light(file_, std::size_t(chosen));
        if (const std::size_t dropped = validate(scene_))
            file_.warn(std::to_string(dropped) +
                       " triangles without area or with corners that are no numbers are left out.");
        return std::move(scene_);
    }

  private:
    struct Visit {
        int node;
        bool visible;
    };

    void walk(const std::vector<int>& roots) {
        std::vector<Visit> stack;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, true});
        std::vector<bool> visited(file_.nodes.size());
        while (!stack.empty()) {
            Visit visit = stack.back();
            stack.pop_back();
            const std::size_t index = std::size_t(visit.node);
            const Node& node = file_.nodes[index];
            if (visited[index])
                throw Error(Exit::scene,
                            label("node", index, node.name) + " is in the scene more than once.");
            visited[index] = true;
            const dmat4 to_world = nodes_.to_world(index);
            visit.visible = visit.visible && node.visible;
            if (node.mesh >= 0 && visit.visible) place_mesh(node, index, to_world);
            if (node.light >= 0 && visit.visible) place_light(node, index, to_world);
            if (node.camera >= 0) place_camera(node, index, to_world);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.push_back({*child, visit.visible});
        }
    }

    /// A skin puts its mesh where the joints are, wherever its node is.
    const Skin* skin_of(const Node& node) {
        if (node.skin < 0) return nullptr;
        const auto found = skins_.find(node.skin);
        return &(found != skins_.end() ? found
                                       : skins_.emplace(node.skin, skin_at(file_, nodes_, node.skin)).first)
                    ->second;
    }

    void place_mesh(const Node& node, std::size_t index, const dmat4& node_to_world) {
        const std::string what = label("node", index, node.name);
        const Skin* skin = skin_of(node);
        const std::size_t mesh = meshes_.use(node.mesh, node.skin, {nodes_.weights(index), skin});
        const dmat4 to_world = skin ? glm::translate(dmat4(1.0), skin->centre) : node_to_world;
        const std::string& name = node.name.empty() ? scene_.meshes[mesh].name : node.name;
        if (node.instancing.empty()) {
            file_.charge_instances(1, what);
            return place({name, mesh, to_world}, what);
        }
        const Instancing instancing(file_, node.instancing.front(), what);
        file_.charge_instances(instancing.size(), what);
        reserve_more(scene_.instances, instancing.size());
        for (std::size_t i = 0; i < instancing.size(); ++i)
            place({name, mesh, to_world * instancing.transform(i)}, what);
    }

    void place(MeshInstance instance, const std::string& what) {
        if (is_invertible(instance.to_world))
            scene_.instances.push_back(std::move(instance));
        else
            file_.warn(what + " is scaled to nothing; it is left out.");
    }

    void place_light(const Node& node, std::size_t index, const dmat4& to_world) {
        const auto which = std::size_t(node.light);
        const tinygltf::Light& source = file_.model.lights[which];
        const std::string what = label("light", which, source.name);
        PunctualLight light;
        light.name = source.name.empty() ? node.name : source.name;
        if (source.type == "point")
            light.type = PunctualLight::Type::point;
        else if (source.type == "spot")
            light.type = PunctualLight::Type::spot;
        else if (source.type == "directional")
            light.type = PunctualLight::Type::directional;
        else
            throw Error(Exit::scene, what + " has the unknown type '" + source.type.substr(0, 40) + "'.");
        if (const auto& c = source.color; c.size() == 3)
            light.colour = glm::clamp(vec3(c[0], c[1], c[2]), 0.0f, 1e30f);
        light.colour *= float(std::min(source.intensity, 1e30));
        light.range =
            light.type == PunctualLight::Type::directional ? 0.0f : float(std::min(source.range, 1e30));
        light.position = dvec3(to_world[3]);
        const dvec3 direction = -dvec3(to_world[2]);
        const double length = glm::length(direction);
        if (!(length > 0.0) || !std::isfinite(length)) {
            if (light.type != PunctualLight::Type::point)
                return file_.warn(label("node", index, node.name) +
                                  " is scaled to nothing; its light has no direction.");
        } else {
            light.direction = direction / length;
        }
        light.outer_cone = float(source.spot.outerConeAngle);
        light.inner_cone = float(source.spot.innerConeAngle);
        if (light.type == PunctualLight::Type::spot && light.inner_cone > light.outer_cone)
            throw Error(Exit::scene, what + " has an innerConeAngle larger than its outerConeAngle.");
        light.spectrum = light_extras(source.extras, what, [this](const std::string& s) { file_.warn(s); });
        scene_.lights.push_back(light);
    }

    void place_camera(const Node& node, std::size_t index, const dmat4& to_world) {
        const tinygltf::Camera& source = file_.model.cameras[std::size_t(node.camera)];
        const std::string what = label("camera", std::size_t(node.camera), source.name);
        if (!is_invertible(to_world))
            return file_.warn(label("node", index, node.name) +
                              " is scaled to nothing; its camera is left out.");
        SceneCamera camera;
        camera.name = source.name.empty() ? node.name : source.name;
        if (source.type == "perspective") {
            if (!(source.perspective.yfov > 0.0))
                throw Error(Exit::scene, what + " has no perspective.yfov.");
            camera.yfov = source.perspective.yfov;
            camera.aspect = source.perspective.aspectRatio;
        } else if (source.type == "orthographic") {
            camera.orthographic = true;
            camera.magnification = glm::abs(dvec2(source.orthographic.xmag, source.orthographic.ymag));
            if (!(camera.magnification.x > 1e-12 && camera.magnification.y > 1e-12))
                throw Error(Exit::scene, what + " has an xmag or ymag of zero.");
        } else {
            throw Error(Exit::scene, what + " has the unknown type '" + source.type.substr(0, 40) + "'.");
        }
        // A camera has no scale: keep where it is, where it looks and which way is up.
        const dvec3 back = glm::normalize(dvec3(to_world[2]));
        const dvec3 right = glm::normalize(glm::cross(dvec3(to_world[1]), back));
        camera.to_world =
            dmat4(dvec4(right, 0.0), dvec4(glm::cross(back, right), 0.0), dvec4(back, 0.0), to_world[3]);
        scene_.cameras.push_back(camera);
    }

    File& file_;
    const GltfChoice& choice_;
    PosedNodes nodes_;
    std::map<int, Skin> skins_;
    Scene scene_;
    Materials materials_;
    Meshes meshes_;
};

}  // namespace
}  // namespace triad::gltf

namespace triad {

namespace {

void require_whole(const GltfReport& report) {
    const std::size_t n = report.faults.size();
    if (n == 0) return;
    throw Error(Exit::scene,
                report.faults.front() +
                    (n == 1 ? "" : " There are " + std::to_string(n - 1) + " more such faults.") +
                    " Without --strict it is rendered all the same.");
}

Scene load(const std::filesystem::path& path, const GltfChoice& choice, GltfReport* report) {
    gltf::File file = gltf::read_file(path);
    Scene scene = gltf::SceneBuilder(file, choice).build();
    if (choice.strict) require_whole(file.report);
    if (report) *report = std::move(file.report);
    return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfChoice& choice, GltfReport* report) {
    try {
        Scene scene = load(path, choice, report);
        give_back_freed_memory();  // of the document, of which nothing is left
        return scene;
    } catch (const Error& e) {
        throw gltf::named(e, path);
    } catch (const std::bad_alloc&) {
        throw Error(Exit::memory, path.string() + ": there is not enough memory for this scene.");
    } catch (const std::length_error&) {
        throw Error(Exit::memory, path.string() + ": there is not enough memory for this scene.");
    }
}

}  // namespace triad
