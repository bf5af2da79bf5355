/// Nodes: where meshes, lights and cameras are.
#include <algorithm>
#include <cmath>
#include <new>

#include "base/error.h"
#include "io/gltf_accessor.h"
#include "io/gltf_extras.h"
#include "io/gltf_material.h"
#include "io/gltf_mesh.h"
#include "scene/scene.h"

namespace triad::gltf {
namespace {

using tinygltf::Value;

dmat4 translate_rotate_scale(const dvec3& t, const dquat& r, const dvec3& s) {
    const dmat3 m = glm::mat3_cast(r);
    return dmat4(dvec4(m[0] * s.x, 0.0), dvec4(m[1] * s.y, 0.0), dvec4(m[2] * s.z, 0.0), dvec4(t, 1.0));
}

/// True when the matrix can be inverted with some accuracy left.
bool is_invertible(const dmat4& m) {
    const double volume = glm::length(dvec3(m[0])) * glm::length(dvec3(m[1])) * glm::length(dvec3(m[2]));
    const double det = glm::determinant(dmat3(m));
    return std::isfinite(volume) && volume > 0.0 && std::abs(det) > 1e-12 * volume;
}

const Value* extension_of(const tinygltf::Node& node, const char* name) {
    const auto found = node.extensions.find(name);
    return found != node.extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

class SceneBuilder {
  public:
    explicit SceneBuilder(File& file)
        : file_(file), materials_(file, scene_), meshes_(file, scene_, materials_) {}

    Scene build(const GltfChoice& choice) {
        const auto& scenes = file_.model.scenes;
        if (choice.scene >= int(scenes.size()))
            throw Error(Exit::scene, "Scene " + std::to_string(choice.scene) +
                                         " was asked for, but the file has " + std::to_string(scenes.size()) +
                                         ".");
        const int chosen = choice.scene >= 0 ? choice.scene : std::max(file_.model.defaultScene, 0);
        if (chosen < int(scenes.size())) {
            scene_.name = scenes[std::size_t(chosen)].name;
            walk(scenes[std::size_t(chosen)].nodes);
        }
        materials_.decode_images(choice.max_texture);
        if (const std::size_t dropped = validate(scene_))
            file_.warn(std::to_string(dropped) +
                       " triangles without area or with corners that are no numbers are left out.");
        return std::move(scene_);
    }

  private:
    struct Visit {
        int node;
        dmat4 parent;
        bool visible;
    };

    void walk(const std::vector<int>& roots) {
        std::vector<Visit> stack;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            stack.push_back({*root, dmat4(1.0), true});
        std::vector<bool> visited(file_.model.nodes.size());
        while (!stack.empty()) {
            Visit visit = stack.back();
            stack.pop_back();
            const std::size_t index = std::size_t(visit.node);
            const tinygltf::Node& node = file_.model.nodes[index];
            if (visited[index])
                throw Error(Exit::scene,
                            label("node", index, node.name) + " is in the scene more than once.");
            visited[index] = true;
            const dmat4 to_world = visit.parent * local_transform(node, index);
            if (const Value* e = extension_of(node, "KHR_node_visibility"); e && e->Has("visible"))
                visit.visible = visit.visible && e->Get("visible").Get<bool>();
            if (node.mesh >= 0 && visit.visible) place_mesh(node, index, to_world);
            if (visit.visible) place_light(node, index, to_world);
            if (node.camera >= 0) place_camera(node, index, to_world);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.push_back({*child, to_world, visit.visible});
        }
    }

    dmat4 local_transform(const tinygltf::Node& node, std::size_t index) {
        const std::string what = label("node", index, node.name);
        if (!node.matrix.empty()) {
            if (!node.translation.empty() || !node.rotation.empty() || !node.scale.empty())
                throw Error(Exit::scene, what + " has both a matrix and translation, rotation or scale.");
            dmat4 m = glm::make_mat4(node.matrix.data());
            if (m[0].w != 0.0 || m[1].w != 0.0 || m[2].w != 0.0 || m[3].w != 1.0) {
                file_.warn(what + " has a projective matrix; its last row is taken as 0 0 0 1.");
                m[0].w = m[1].w = m[2].w = 0.0, m[3].w = 1.0;
            }
            return m;
        }
        const auto vector = [](const std::vector<double>& v, double otherwise) {
            return v.empty() ? dvec3(otherwise) : dvec3(v[0], v[1], v[2]);
        };
        dquat rotation(1.0, 0.0, 0.0, 0.0);
        if (const auto& r = node.rotation; !r.empty())
            rotation = unit_quaternion(dquat(r[3], r[0], r[1], r[2]), what);
        return translate_rotate_scale(vector(node.translation, 0.0), rotation, vector(node.scale, 1.0));
    }

    static dquat unit_quaternion(const dquat& q, const std::string& what) {
        const double length = glm::length(q);
        if (!(length > 1e-9) || !std::isfinite(length))
            throw Error(Exit::scene, what + " has a rotation that is no unit quaternion.");
        return q / length;
    }

    void place_mesh(const tinygltf::Node& node, std::size_t index, const dmat4& to_world) {
        if (node.skin >= 0)
            file_.warn(label("node", index, node.name) + " has a skin; its mesh is rendered undeformed.");
        const std::size_t mesh = meshes_.use(node.mesh);
        const Value* instancing = extension_of(node, "EXT_mesh_gpu_instancing");
        if (!instancing) return place(node, index, mesh, to_world);
        for (const dmat4& instance : instance_transforms(*instancing, label("node", index, node.name)))
            place(node, index, mesh, to_world * instance);
    }

    void place(const tinygltf::Node& node, std::size_t index, std::size_t mesh, const dmat4& to_world) {
        if (!is_invertible(to_world))
            return file_.warn(label("node", index, node.name) + " is scaled to nothing; it is left out.");
        file_.charge_instances(1, label("node", index, node.name));
        scene_.instances.push_back(
            {node.name.empty() ? scene_.meshes[mesh].name : node.name, mesh, to_world});
    }

    std::vector<dmat4> instance_transforms(const Value& extension, const std::string& node) {
        const std::string what = node + ", EXT_mesh_gpu_instancing";
        const Value& attributes = extension.Get("attributes");
        const auto accessor = [&](const char* name) {
            return attributes.Has(name) ? attributes.Get(std::string(name)).GetNumberAsInt() : -1;
        };
        std::optional<std::size_t> count;
        for (const std::string& name : attributes.Keys()) {
            const std::size_t n =
                file_.model.accessors[std::size_t(attributes.Get(name).GetNumberAsInt())].count;
            if (count.value_or(n) != n)
                throw Error(Exit::scene, what + ": its attributes have different counts.");
            count = n;
        }
        std::vector<vec3> translations, scales;
        std::vector<vec4> rotations;
        if (const int a = accessor("TRANSLATION"); a >= 0)
            translations = read_vec3(file_, a, Integers::none, what + ": TRANSLATION");
        if (const int a = accessor("ROTATION"); a >= 0)
            rotations = read_vec4(file_, a, Integers::signed_normalised, what + ": ROTATION");
        if (const int a = accessor("SCALE"); a >= 0)
            scales = read_vec3(file_, a, Integers::none, what + ": SCALE");
        file_.charge(count.value_or(0) * sizeof(dmat4), what);
        std::vector<dmat4> result;
        for (std::size_t i = 0; i < count.value_or(0); ++i) {
            const vec4 r = rotations.empty() ? vec4(0.0f, 0.0f, 0.0f, 1.0f) : rotations[i];
            result.push_back(
                translate_rotate_scale(translations.empty() ? dvec3(0.0) : dvec3(translations[i]),
                                       unit_quaternion(dquat(r.w, r.x, r.y, r.z), what),
                                       scales.empty() ? dvec3(1.0) : dvec3(scales[i])));
        }
        return result;
    }

    void place_light(const tinygltf::Node& node, std::size_t index, const dmat4& to_world) {
        const Value* extension = extension_of(node, "KHR_lights_punctual");
        if (!extension) return;
        const std::size_t which = std::size_t(number(*extension, "light", 0));
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

    void place_camera(const tinygltf::Node& node, std::size_t index, const dmat4& to_world) {
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

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfChoice& choice, GltfReport* report) {
    try {
        gltf::File file = gltf::read_file(path);
        Scene scene = gltf::SceneBuilder(file).build(choice);
        if (choice.strict) require_whole(file.report);
        if (report) *report = std::move(file.report);
        return scene;
    } catch (const Error& e) {
        const std::string name = path.string();
        if (std::string(e.what()).find(name) != std::string::npos) throw;
        throw Error(e.exit(), name + ": " + e.what());
    } catch (const std::bad_alloc&) {
        throw Error(Exit::memory, path.string() + ": there is not enough memory for this scene.");
    } catch (const std::length_error&) {
        throw Error(Exit::memory, path.string() + ": there is not enough memory for this scene.");
    }
}

}  // namespace triad
