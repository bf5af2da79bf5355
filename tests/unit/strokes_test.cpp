// Points and lines: as wide as asked for in the picture, wherever they are, and turned to the eye.
#include "scene/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace triad {
namespace {

constexpr unsigned height = 100;

/// Looks along -z from the origin with a half angle of 45 degrees.
View view() { return {}; }

Scene scene_of(std::vector<vec3> positions, std::vector<uvec2> strokes, const dmat4& to_world = dmat4(1.0)) {
    Scene scene;
    Primitive p;
    p.positions = std::move(positions);
    p.strokes = std::move(strokes);
    scene.materials.push_back({.unlit = true});
    scene.meshes.push_back({"strokes", {p}});
    scene.instances.push_back({"placed", 0, to_world});
    return scene;
}

/// Where the triangles of the last mesh reach in the picture: column and row, from the middle, in pixels.
Bounds in_picture(const Scene& scene) {
    Bounds bounds;
    const MeshInstance& instance = scene.instances.back();
    const Primitive& p = scene.meshes[instance.mesh].primitives.at(0);
    for (const uvec3& t : p.triangles)
        for (int k = 0; k < 3; ++k) {
            const dvec3 at = transform_point(instance.to_world, dvec3(p.positions[t[k]]));
            bounds.add(dvec3(at.x, at.y, 0) / -at.z * double(height) / 2.0);
        }
    return bounds;
}

TEST(Strokes, a_point_is_as_many_pixels_wide_near_and_far) {
    for (const float depth : {1.0f, 30.0f, 5000.0f}) {
        Scene scene = scene_of({{0, 0, -depth}}, {{0, 0}});
        EXPECT_TRUE(has_strokes(scene));
        draw_strokes(scene, view(), height, 2.0);
        EXPECT_FALSE(has_strokes(scene));
        const dvec3 size = in_picture(scene).size();
        EXPECT_NEAR(size.x, 2.0, 0.05) << depth;
        EXPECT_NEAR(size.y, 2.0, 0.3) << "a hexagon";
    }
}

TEST(Strokes, what_is_placed_larger_or_turned_is_no_wider) {
    Scene scene = scene_of({{0, 0, -1}}, {{0, 0}}, glm::scale(dmat4(1.0), dvec3(1000)));
    draw_strokes(scene, view(), height, 2.0);
    EXPECT_NEAR(in_picture(scene).size().x, 2.0, 0.05);
}

TEST(Strokes, a_line_across_has_its_width_and_a_line_into_the_depth_has_it_everywhere) {
    Scene across = scene_of({{-1, 0, -10}, {1, 0, -10}}, {{0, 1}});
    draw_strokes(across, view(), height, 2.0);
    EXPECT_NEAR(in_picture(across).size().y, 2.0, 0.05);
    EXPECT_NEAR(in_picture(across).size().x, 0.2 * height / 2 + 2.0, 0.1);

    Scene along = scene_of({{1, 0, -2}, {1, 0, -2000}}, {{0, 1}});
    draw_strokes(along, view(), height, 2.0);
    EXPECT_LT(in_picture(along).size().y, 2.0 * 1.2);
}

TEST(Strokes, surfaces_face_the_eye_and_so_do_normals) {
    Scene scene = scene_of({{-1, 2, -10}, {1, 1, -5}, {0, -3, -4}}, {{0, 1}, {1, 2}, {2, 2}});
    scene.meshes[0].primitives[0].normals = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
    draw_strokes(scene, view(), height, 3.0);
    validate(scene);
    const MeshInstance& instance = scene.instances.back();
    const Primitive& p = scene.meshes[instance.mesh].primitives.at(0);
    EXPECT_FALSE(p.triangles.empty());
    for (const uvec3& t : p.triangles) {
        dvec3 at[3];
        for (int k = 0; k < 3; ++k) {
            at[k] = transform_point(instance.to_world, dvec3(p.positions[t[k]]));
            EXPECT_GT(glm::dot(dvec3(p.normals[t[k]]), glm::normalize(-at[k])), -0.05);
        }
        EXPECT_GT(glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), -at[0]), 0.0);
    }
}

TEST(Strokes, a_line_seen_end_on_is_a_cap_and_one_through_the_eye_is_no_trouble) {
    Scene scene = scene_of({{0, 0, -1}, {0, 0, -2}, {0.1f, 0, 5}, {0.1f, 0, -5}}, {{0, 1}, {2, 3}});
    draw_strokes(scene, view(), height, 2.0);
    EXPECT_EQ(validate(scene), 0u);
    for (const vec3& at : scene.meshes.back().primitives.at(0).positions)
        for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(at[k]));
}

TEST(Strokes, triangles_beside_them_stay_and_bounds_count_both) {
    Scene scene = scene_of({{0, 0, -4}, {1, 0, -4}, {0, 1, -4}, {9, 0, -4}}, {{3, 3}});
    scene.meshes[0].primitives[0].triangles = {{0, 1, 2}};
    EXPECT_EQ(bounds_of(scene).hi.x, 9);
    draw_strokes(scene, view(), height, 1.0);
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.meshes[0].primitives[0].triangles.size(), 1u);
}

}  // namespace
}  // namespace triad
