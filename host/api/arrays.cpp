// Scenes of arrays.
#include <algorithm>
#include <cmath>

#include "api/guard.h"
#include "api/inside.h"
#include "base/error.h"

namespace triad::api {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
    throw triad::Error(Exit::scene, what + " " + why + ".");
}

std::string label(const char* kind, std::size_t i, const std::string& name) {
    return std::string(kind) + " " + std::to_string(i) + (name.empty() ? "" : " '" + name + "'");
}

/// So many vectors, of an array that holds them one after the other.
template <class Vector, class Value>
std::vector<Vector> vectors(std::span<const Value> values, const std::string& what) {
    constexpr std::size_t n = std::size_t(Vector::length());
    if (values.size() % n != 0)
        refuse(what, "have " + std::to_string(values.size()) + " values, which is no multiple of " +
                         std::to_string(n));
    std::vector<Vector> all(values.size() / n);
    for (std::size_t i = 0; i < values.size(); ++i) all[i / n][int(i % n)] = values[i];
    return all;
}

void require_as_many(std::size_t count, std::size_t vertices, const std::string& what) {
    if (count != 0 && count != vertices)
        refuse(what, "are " + std::to_string(count) + ", and its positions " + std::to_string(vertices));
}

std::vector<vec3> unit(std::vector<vec3> normals, const std::string& what) {
    for (vec3& normal : normals) {
        const double length = glm::length(dvec3(normal));
        if (!(length > 0) || !std::isfinite(length)) refuse(what, "include one without a direction");
        normal = vec3(dvec3(normal) / length);
    }
    return normals;
}

Primitive primitive_of(const Mesh& mesh, const std::string& what) {
    Primitive primitive;
    primitive.positions = vectors<vec3>(mesh.positions, "The positions of " + what);
    primitive.triangles = vectors<uvec3>(mesh.indices, "The indices of " + what);
    primitive.normals = unit(vectors<vec3>(mesh.normals, "The normals of " + what), "The normals of " + what);
    primitive.uvs[0] = vectors<vec2>(mesh.uvs, "The uvs of " + what);
    const std::size_t vertices = primitive.positions.size();
    require_as_many(primitive.normals.size(), vertices, "The normals of " + what);
    require_as_many(primitive.uvs[0].size(), vertices, "The uvs of " + what);
    for (const std::uint32_t index : mesh.indices)
        if (index >= vertices)
            refuse("The indices of " + what, "include " + std::to_string(index) + ", and it has " +
                                                 std::to_string(vertices) + " vertices");
    primitive.material = mesh.material;
    return primitive;
}

void add_mesh(triad::Scene& scene, const Mesh& mesh, const std::string& what) {
    if (mesh.material >= scene.materials.size())
        refuse(what, "has material " + std::to_string(mesh.material) + ", and there are " +
                         std::to_string(scene.materials.size()));
    dmat4 to_world;
    for (int i = 0; i < 16; ++i) to_world[i / 4][i % 4] = mesh.to_world[std::size_t(i)];
    if (to_world[0].w != 0 || to_world[1].w != 0 || to_world[2].w != 0 || to_world[3].w != 1)
        refuse(what, "has a matrix whose last row is not 0, 0, 0, 1");
    scene.meshes.push_back({mesh.name, {primitive_of(mesh, what)}});
    scene.instances.push_back({.name = mesh.name, .mesh = scene.meshes.size() - 1, .to_world = to_world});
}

/// Whether any texel lets through what is behind.
bool is_translucent(const Texture& texture) {
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
        if (texture.rgba[i] != 255) return true;
    return false;
}

TextureUse add_texture(triad::Scene& scene, const Texture& texture, const std::string& what) {
    if (texture.width < 1 || texture.height < 1 ||
        texture.rgba.size() != std::uint64_t(texture.width) * texture.height * 4)
        refuse("The texture of " + what, "has " + std::to_string(texture.rgba.size()) + " bytes for " +
                                             std::to_string(texture.width) + " x " +
                                             std::to_string(texture.height) + " texels of 4");
    scene.images.push_back(
        {"", texture.width, texture.height, 8, {texture.rgba.begin(), texture.rgba.end()}});
    scene.textures.push_back({.image = scene.images.size() - 1});
    return {.texture = scene.textures.size() - 1};
}

void add_material(triad::Scene& scene, const Material& m, const std::string& what) {
    triad::Material material;
    material.name = m.name;
    for (int c = 0; c < 4; ++c) material.base_colour[c] = m.base_colour[std::size_t(c)];
    for (int c = 0; c < 3; ++c) material.emission[c] = m.emission[std::size_t(c)];
    material.metallic = m.metallic, material.roughness = m.roughness;
    material.transmission = m.transmission, material.thickness = m.thickness, material.ior = m.ior;
    material.double_sided = m.double_sided;
    bool translucent = m.base_colour[3] < 1;
    if (m.base_colour_texture) {
        material.base_colour_texture = add_texture(scene, *m.base_colour_texture, what);
        translucent = translucent || is_translucent(*m.base_colour_texture);
    }
    if (translucent) material.alpha_mode = AlphaMode::blend;
    scene.materials.push_back(std::move(material));
}

SceneCamera camera_of(const Camera& camera) {
    const auto vector = [](const std::array<double, 3>& v) { return dvec3(v[0], v[1], v[2]); };
    const dvec3 eye = vector(camera.eye), back = eye - vector(camera.target), up = vector(camera.up);
    const dvec3 right = glm::cross(up, back);
    if (!(glm::length(right) > 1e-9 * glm::length(up) * glm::length(back)) ||
        !std::isfinite(glm::length(right)))
        refuse("The camera", "has eye and target in one place, or looks along its up");
    if (!(camera.fov >= 0.001 && camera.fov <= 179))
        refuse("The camera", "has an angle of view outside of .001 to 179 degrees");
    const dvec3 x = glm::normalize(right), z = glm::normalize(back), y = glm::cross(z, x);
    return {.name = "camera",
            .yfov = camera.fov * pi / 180,
            .to_world = dmat4(dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), dvec4(eye, 1))};
}

}  // namespace

Scene make_scene(std::span<const Mesh> meshes, std::span<const Material> materials,
                 const std::optional<Camera>& camera) {
    return guarded([&] {
        triad::Scene scene;
        for (std::size_t i = 0; i < materials.size(); ++i)
            add_material(scene, materials[i], label("Material", i, materials[i].name));
        if (materials.empty()) add_material(scene, {}, "");
        for (std::size_t i = 0; i < meshes.size(); ++i)
            add_mesh(scene, meshes[i], label("Mesh", i, meshes[i].name));
        if (camera) scene.cameras.push_back(camera_of(*camera));
        validate(scene);
        RenderRequest request;
        // What pictures say of where they come from, and what goes on with a film of theirs looks for in
        // vain.
        request.scene_path = "arrays";
        request.words = {request.scene_path};
        return Scene(
            std::make_shared<const Scene::Inside>(Scene::Inside{std::move(request), {std::move(scene), {}}}));
    });
}

}  // namespace triad::api
