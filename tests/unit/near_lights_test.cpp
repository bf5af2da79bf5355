// Triangle lights are drawn by solid angle where much of their light is reflected near them.
#include <gtest/gtest.h>

#include <algorithm>

#include "pack/pack.h"
#include "scene/shapes.h"

namespace triad {
namespace {

Material painted(float albedo, float metallic = 0.0f) {
    Material m;
    m.base_colour = {albedo, albedo, albedo, 1.0f};
    m.metallic = metallic;
    return m;
}

Material lamp(bool both_sides) {
    Material m = painted(0.0f);
    m.emission = vec3(1.0f);
    m.double_sided = both_sides;
    return m;
}

void place(Scene& scene, Primitive form, const Material& material, const dmat4& to_world = dmat4(1.0)) {
    form.material = scene.materials.size();
    scene.materials.push_back(material);
    scene.meshes.push_back({"mesh", {std::move(form)}});
    scene.instances.push_back({"node", scene.meshes.size() - 1, to_world});
}

/// A floor of 10 x 10, and a square of 1 x 1 at a height, which shines down alone or up and down.
Scene floor_below(double height, bool both_sides, const Material& floor) {
    Scene scene;
    place(scene, shapes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), floor);
    place(scene, shapes::quad({-0.5f, float(height), -0.5f}, {1, 0, 0}, {0, 0, 1}), lamp(both_sides));
    return scene;
}

std::size_t near_lights(Scene scene, const dvec3& eye = dvec3(0, 1, 4)) {
    validate(scene);
    RenderSettings settings;
    settings.view = look_at(eye, dvec3(0.0), 1.0, 1.0);
    const PackedScene packed = pack(scene, settings);
    const auto near = std::size_t(std::count_if(packed.lights.begin(), packed.lights.end(),
                                                [](const dev::Light& l) { return l.range > 0; }));
    EXPECT_EQ(features_of(packed, settings).near_lights, near > 0);
    return near;
}

TEST(NearLights, a_lamp_is_near_a_bright_floor_within_its_reach) {
    EXPECT_EQ(near_lights(floor_below(0.5, false, painted(0.6f))), 2u);
    EXPECT_EQ(near_lights(floor_below(0.5, true, painted(0.6f))), 2u);
    EXPECT_EQ(near_lights(floor_below(3.0, true, painted(0.6f))), 0u);
}

TEST(NearLights, what_reflects_nothing_diffusely_does_not_count) {
    EXPECT_EQ(near_lights(floor_below(0.5, false, painted(0.05f))), 0u);
    EXPECT_EQ(near_lights(floor_below(0.5, false, painted(0.9f, 1.0f))), 0u);
}

TEST(NearLights, behind_a_lamp_of_one_side_is_nothing) {
    Scene scene = floor_below(0.5, false, painted(0.6f));
    scene.instances[0].to_world = glm::translate(dmat4(1.0), dvec3(0, 1, 0));  // the floor is above it
    EXPECT_EQ(near_lights(scene), 0u);
    scene.materials[1].double_sided = true;
    EXPECT_EQ(near_lights(scene), 2u);
}

TEST(NearLights, a_lamp_alone_is_not_near_itself) {
    Scene scene = floor_below(0.5, true, painted(0.6f));
    scene.materials[1].base_colour = vec4(1.0f);
    scene.instances[0].to_world = glm::translate(dmat4(1.0), dvec3(0, -20, 0));
    EXPECT_EQ(near_lights(scene), 0u);
}

TEST(NearLights, size_and_place_of_a_scene_change_nothing) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        Scene scene = floor_below(0.5, false, painted(0.6f));
        for (MeshInstance& i : scene.instances)
            i.to_world = glm::translate(glm::scale(dmat4(1.0), dvec3(scale)), dvec3(7, -3, 11));
        EXPECT_EQ(near_lights(scene, scale * dvec3(7, -2, 15)), 2u) << scale;
    }
}

TEST(NearLights, a_fine_mesh_counts_as_a_coarse_one) {
    for (const unsigned cells : {1u, 40u, 400u}) {  // 400: more triangles than are asked
        Scene scene;
        place(scene, shapes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, cells, cells), painted(0.14f));
        place(scene, shapes::quad({-0.5f, 0.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}), lamp(false));
        EXPECT_EQ(near_lights(scene), 2u) << cells;
        scene.materials[0] = painted(0.1f);
        EXPECT_EQ(near_lights(scene), 0u) << cells;
    }
}

}  // namespace
}  // namespace triad
