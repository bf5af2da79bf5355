// The scene as data: what validate() must find, what hash_of() must tell apart.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/error.h"
#include "scene/limits.h"
#include "scene/scene.h"

namespace triad {
namespace {

Scene small_scene() {
    Scene scene;
    scene.images.push_back({"white", 1, 1, 8, {255, 255, 255, 255}});
    scene.textures.push_back({});
    scene.materials.push_back({});
    Material& m = scene.materials[0];
    m.base_colour_texture = TextureUse{};
    m.clearcoat = Clearcoat{.factor = 1, .texture = TextureUse{}};
    m.sheen = Sheen{.colour = vec3(1)};
    m.anisotropy = Anisotropy{.strength = 1};
    m.iridescence = Iridescence{.factor = 1};
    m.diffuse_transmission = DiffuseTransmission{.factor = 1};
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.triangles = {{0, 1, 2}};
    scene.meshes.push_back({"mesh", {p}});
    scene.instances.push_back({"instance", 0, dmat4(1.0)});
    scene.lights.push_back({});
    scene.cameras.push_back({});
    return scene;
}

const std::vector<std::function<void(Scene&)>> faults{
    [](Scene& s) { s.images[0].texels.pop_back(); },
    [](Scene& s) { s.images[0].bits = 32; },
    [](Scene& s) { s.textures[0].image = 1; },
    [](Scene& s) { s.materials[0].base_colour.x = 2; },
    [](Scene& s) { s.materials[0].roughness = NAN; },
    [](Scene& s) { s.materials[0].emission.y = -1; },
    [](Scene& s) { s.materials[0].ior = 0.5f; },
    [](Scene& s) { s.materials[0].attenuation_distance = 0; },
    [](Scene& s) {
        s.materials[0].dispersion = Dispersion{Dispersion::Law::cauchy, 0, {0.9, 0.01}, {}};
    },
    [](Scene& s) { s.materials[0].priority = 256; },
    [](Scene& s) { s.materials[0].clearcoat->factor = 0; },
    [](Scene& s) { s.materials[0].clearcoat->roughness = 2; },
    [](Scene& s) { s.materials[0].clearcoat->normal_scale = NAN; },
    [](Scene& s) { s.materials[0].clearcoat->texture->texture = 9; },
    [](Scene& s) { s.materials[0].sheen->colour = vec3(0); },
    [](Scene& s) { s.materials[0].sheen->colour.x = 2; },
    [](Scene& s) { s.materials[0].sheen->roughness = -1; },
    [](Scene& s) { s.materials[0].anisotropy->strength = 2; },
    [](Scene& s) { s.materials[0].anisotropy->rotation = INFINITY; },
    [](Scene& s) { s.materials[0].iridescence->factor = NAN; },
    [](Scene& s) { s.materials[0].iridescence->ior = 0.5f; },
    [](Scene& s) { s.materials[0].iridescence->thickness_minimum = -1; },
    [](Scene& s) { s.materials[0].iridescence->thickness_maximum = NAN; },
    [](Scene& s) { s.materials[0].diffuse_transmission->factor = -1; },
    [](Scene& s) { s.materials[0].diffuse_transmission->colour.z = NAN; },
    [](Scene& s) { s.materials[0].base_colour_texture->texture = 9; },
    [](Scene& s) { s.materials[0].base_colour_texture->uv_set = 2; },
    [](Scene& s) { s.meshes[0].primitives[0].material = 1; },
    [](Scene& s) { s.meshes[0].primitives[0].triangles[0].z = 3; },
    [](Scene& s) { s.meshes[0].primitives[0].normals.assign(2, vec3(0, 0, 1)); },
    [](Scene& s) { s.meshes[0].primitives[0].normals.assign(3, vec3(0, 0, 2)); },
    [](Scene& s) { s.meshes[0].primitives[0].tangents.assign(3, vec4(1, 0, 0, 0)); },
    [](Scene& s) { s.instances[0].mesh = 1; },
    [](Scene& s) { s.instances[0].to_world = dmat4(0.0); },
    [](Scene& s) { s.instances[0].to_world[3].x = INFINITY; },
    [](Scene& s) { s.instances[0].to_world[0].x = 1e35; },
    [](Scene& s) { s.lights[0].direction = dvec3(0.0); },
    [](Scene& s) { s.lights[0].colour.x = NAN; },
    [](Scene& s) { s.lights[0].inner_cone = 1.0f; },
    [](Scene& s) { s.cameras[0].yfov = 0; },
    [](Scene& s) { s.cameras[0].magnification.y = 0; },
    [](Scene& s) {
        s.environment = EnvironmentMap{2, 1, {1, 1, 1}};
    },
    [](Scene& s) { s.sky.z = -1; },
};

TEST(Scene, every_broken_invariant_is_found) {
    Scene good = small_scene();
    EXPECT_EQ(validate(good), 0u);
    for (std::size_t i = 0; i < faults.size(); ++i) {
        Scene scene = small_scene();
        faults[i](scene);
        EXPECT_THROW(validate(scene), Error) << "fault " << i;
    }
}

/// What float cannot work with, and what the sentence must name.
struct Beyond {
    std::function<void(Scene&)> enlarge;
    const char* where;
};
const std::vector<Beyond> beyond{
    {[](Scene& s) { s.meshes[0].primitives[0].positions[1].x = 5e19f; }, "Mesh 0 'mesh', primitive 0"},
    {[](Scene& s) { s.instances[0].to_world[3].y = -2e11; }, "The scene, placed,"},
    {[](Scene& s) { s.instances[0].to_world[0].x = 1e12; }, "The scene, placed,"},
    {[](Scene& s) { s.instances[0].to_world[0].x = 1e19; }, "Instance 0 'instance'"},
    {[](Scene& s) { s.lights[0].position.z = 1e300; }, "Light 0"},
    {[](Scene& s) { s.lights[0].colour.y = 1e31f; }, "Light 0"},
    {[](Scene& s) { s.cameras[0].to_world[3].x = 1e300; }, "Camera 0"},
    {[](Scene& s) { s.cameras[0].magnification.x = 1e39; }, "Camera 0"},
    {[](Scene& s) { s.cameras[0].aspect = 1e300; }, "Camera 0"},
    {[](Scene& s) { s.materials[0].emission.x = 1e38f; }, "Material 0"},
    {[](Scene& s) { s.materials[0].normal_scale = 1e20f; }, "Material 0"},
    {[](Scene& s) { s.materials[0].attenuation_distance = 1e-30f; }, "Material 0"},
    {[](Scene& s) { s.materials[0].clearcoat->normal_scale = 1e20f; }, "Material 0"},
    {[](Scene& s) { s.materials[0].iridescence->ior = 1e20f; }, "Material 0"},
    {[](Scene& s) { s.materials[0].iridescence->thickness_maximum = 1e20f; }, "Material 0"},
    {[](Scene& s) {
         s.environment = EnvironmentMap{1, 1, {1, 1e38f, 1}};
     },
     "The environment map"},
    {[](Scene& s) { s.sky.x = 1e38f; }, "The sky"},
};

TEST(Scene, numbers_that_float_cannot_work_with_are_refused) {
    for (std::size_t i = 0; i < beyond.size(); ++i) {
        Scene scene = small_scene();
        beyond[i].enlarge(scene);
        try {
            validate(scene);
            ADD_FAILURE() << "number " << i;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::scene) << "number " << i;
            EXPECT_EQ(std::string(error.what()).rfind(beyond[i].where, 0), 0u) << error.what();
        }
    }
}

TEST(Scene, numbers_at_the_limits_are_taken) {
    Scene scene = small_scene();
    for (vec3& p : scene.meshes[0].primitives[0].positions) p *= 0.99e11f;
    scene.lights[0].position.x = scene.cameras[0].to_world[3].y = -limits::coordinate;
    scene.cameras[0].magnification = dvec2(limits::coordinate);
    scene.lights[0].colour = scene.materials[0].emission = vec3(0.99e30f);
    EXPECT_EQ(validate(scene), 0u);
}

TEST(Scene, what_cannot_be_drawn_is_dropped_down_to_the_instance) {
    Scene scene = small_scene();
    scene.meshes[0].primitives[0].positions[1].x = NAN;
    EXPECT_EQ(validate(scene), 1u);
    EXPECT_TRUE(scene.meshes[0].primitives.empty());
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(bounds_of(scene).empty());
}

TEST(Scene, bounds_are_those_of_all_points_of_all_instances) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int run = 0; run < 200; ++run) {
        Scene scene = small_scene();
        std::vector<vec3>& positions = scene.meshes[0].primitives[0].positions;
        positions.resize(30);
        for (unsigned i = 1; i < 10; ++i)
            scene.meshes[0].primitives[0].triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        for (vec3& p : positions) p = {normal(random), normal(random), normal(random)};
        scene.instances.resize(30, scene.instances[0]);
        Bounds all;
        for (MeshInstance& instance : scene.instances) {
            if (run % 2)  // on one line, like trees in a row: boxes that touch the bounds
                instance.to_world = glm::translate(dmat4(1), {normal(random), 0, 0});
            else
                for (int k = 0; k < 12; ++k) instance.to_world[k / 3][k % 3] = normal(random);
            for (const uvec3& t : scene.meshes[0].primitives[0].triangles)
                for (int k = 0; k < 3; ++k) all.add(transform_point(instance.to_world, positions[t[k]]));
        }
        const Bounds bounds = bounds_of(scene);
        EXPECT_EQ(bounds.lo, all.lo);
        EXPECT_EQ(bounds.hi, all.hi);
    }
}

TEST(Scene, hash_tells_content_apart_and_names_do_not_matter) {
    const std::string hash = hash_of(small_scene());
    EXPECT_EQ(hash, hash_of(small_scene()));
    EXPECT_EQ(hash.size(), 32u);
    Scene renamed = small_scene();
    renamed.materials[0].name = renamed.meshes[0].name = renamed.instances[0].name = "other";
    EXPECT_EQ(hash_of(renamed), hash);
    for (std::size_t i = 0; i < faults.size(); ++i) {
        Scene scene = small_scene();
        faults[i](scene);
        EXPECT_NE(hash_of(scene), hash) << "change " << i;
    }
}

}  // namespace
}  // namespace triad
