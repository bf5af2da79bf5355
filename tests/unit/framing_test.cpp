// The view of a scene without a camera: what is drawn touches the margin of the picture and no more, whatever
// it is.
#include "scene/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "io/io.h"
#include "scene/farthest_point.h"
#include "scene/strokes.h"
#include "test_assets.h"

namespace triad {
namespace {

constexpr double yfov = 35 * pi / 180;
const double aspects[] = {1.0, 16.0 / 9, 0.4, 3.0};
const dvec3 from_there = glm::normalize(dvec3(0.5, 0.35, 1.0));  // as frame() looks

struct Random {
    std::mt19937 engine{1};
    double operator()(double lo, double hi) { return lo + (hi - lo) * double(engine()) / 4294967296.0; }
    vec3 point() { return {(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)}; }
};

/// A mesh of triangles between these points, three by three, placed as they are.
Scene scene_of(const std::vector<vec3>& positions) {
    Scene scene;
    Primitive p;
    p.positions = positions;
    for (std::uint32_t i = 0; i + 2 < positions.size(); i += 3) p.triangles.emplace_back(i, i + 1, i + 2);
    scene.materials.emplace_back();
    scene.meshes.push_back({"mesh", {p}});
    scene.instances.push_back({"placed", 0, dmat4(1.0)});
    return scene;
}

Scene random_triangles(std::size_t count) {
    Random random;
    std::vector<vec3> positions;
    for (std::size_t i = 0; i < 3 * count; ++i) positions.push_back(random.point());
    return scene_of(positions);
}

/// A rectangle with these two sides.
Scene rectangle(const dvec3& a, const dvec3& b) {
    return scene_of({vec3(-a - b), vec3(a - b), vec3(a + b), vec3(-a - b), vec3(a + b), vec3(b - a)});
}

/// Where all that is drawn reaches in the picture, whose borders are at -1 and 1; in z the depth.
Bounds in_picture(const Scene& scene, const View& view) {
    Bounds bounds;
    const auto add = [&](const dmat4& to_world, const vec3& p) {
        // The eye is taken off first: far from zero, rounding is as large as small things are.
        const dvec3 way = dmat3(to_world) * dvec3(p) + (dvec3(to_world[3]) - view.eye);
        const double depth = glm::dot(way, view.forward);
        bounds.add(dvec3(glm::dot(way, view.right) / view.extent.x / depth,
                         glm::dot(way, view.up) / view.extent.y / depth, depth));
    };
    for (const MeshInstance& instance : scene.instances)
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            for (const uvec3& t : p.triangles)
                for (int k = 0; k < 3; ++k) add(instance.to_world, p.positions[t[k]]);
            for (const uvec2& s : p.strokes)
                for (int k = 0; k < 2; ++k) add(instance.to_world, p.positions[s[k]]);
        }
    return bounds;
}

void expect_tight(const Scene& scene, double aspect, double tolerance = 1e-9) {
    const View view = frame(scene, yfov, aspect);
    const Bounds b = in_picture(scene, view);
    EXPECT_GT(b.lo.z, 0.0);
    EXPECT_NEAR(std::max(b.hi.x, b.hi.y), framed_share, tolerance);
    EXPECT_NEAR(b.lo.x, -b.hi.x, tolerance);
    EXPECT_NEAR(b.lo.y, -b.hi.y, tolerance);
    EXPECT_GT(view.focus_distance, b.lo.z * (1 - tolerance));
    EXPECT_LT(view.focus_distance, b.hi.z * (1 + tolerance));
}

void expect_inside(const Scene& scene, double aspect) {
    const View view = frame(scene, yfov, aspect);
    const Bounds b = in_picture(scene, view);
    EXPECT_TRUE(std::isfinite(glm::length(view.eye) + view.focus_distance));
    EXPECT_GT(b.lo.z, 0.0);
    EXPECT_LE(std::max({b.hi.x, b.hi.y, -b.lo.x, -b.lo.y}), framed_share + 1e-9);
}

TEST(Framing, what_is_drawn_touches_the_margin_and_is_centred) {
    const std::vector<std::function<Scene()>> scenes{
        [] { return random_triangles(4); },
        [] { return random_triangles(5000); },
        [] {
            return rectangle({1, 0, 0}, {0, 1, 0});
        },
        [] {
            return rectangle({9, 0, 0}, {0, 0.01, 0});
        },
        [] {
            return rectangle({0, 0, 50}, {0.1, 0, 0});
        },
        [] {
            return rectangle({1e11, 0, 0}, {0, 0, 1e11});
        },
        [] {
            return rectangle({1e-20, 0, 0}, {0, 1e-20, 0});
        },
        // A plane that the view sees edge-on.
        [] { return rectangle(from_there, glm::normalize(glm::cross(from_there, dvec3(0, 1, 0)))); },
    };
    for (std::size_t i = 0; i < scenes.size(); ++i)
        for (const double aspect : aspects) {
            SCOPED_TRACE("scene " + std::to_string(i) + ", aspect " + std::to_string(aspect));
            expect_tight(scenes[i](), aspect, i == 7 ? 1e-6 : 1e-9);
        }
}

TEST(Framing, instances_count_as_they_are_placed) {
    Scene scene = random_triangles(600);  // more than one block of FarthestPoint
    Random random;
    scene.instances.clear();
    for (int i = 0; i < 300; ++i) {
        dmat4 m(1.0);
        for (int column = 0; column < 3; ++column) m[column] = dvec4(dvec3(random.point()), 0);
        m[3] = dvec4(20.0 * dvec3(random.point()), 1);
        scene.instances.push_back({"", 0, m});
    }
    for (const double aspect : aspects) expect_tight(scene, aspect);
    for (MeshInstance& instance : scene.instances) instance.to_world[3] += dvec4(1e9, -1e9, 1e9, 0);
    for (const double aspect : aspects) expect_tight(scene, aspect, 1e-6);
}

TEST(Framing, a_million_instances_are_framed_as_exactly) {
    Scene scene = random_triangles(2);
    Random random;
    scene.instances.clear();
    for (int i = 0; i < 1000000; ++i)
        scene.instances.push_back({"", 0, glm::translate(dmat4(1.0), 1e3 * dvec3(random.point()))});
    expect_tight(scene, 16.0 / 9);
}

TEST(Framing, the_farthest_point_is_that_of_all_points) {
    Scene scene = random_triangles(2000);
    scene.instances.push_back({"", 0, glm::scale(dmat4(1.0), dvec3(1, -3, 1))});
    const FarthestPoint farthest(scene);
    Random random;
    for (int i = 0; i < 100; ++i) {
        const dvec3 direction = random.point();
        double most = -1e9;
        for (const MeshInstance& instance : scene.instances)
            for (const vec3& p : scene.meshes[0].primitives[0].positions)
                most = std::max(most, glm::dot(direction, transform_point(instance.to_world, p)));
        EXPECT_NEAR(glm::dot(direction, farthest(direction) + farthest.origin()), most, 1e-12);
    }
}

TEST(Framing, vertices_that_no_triangle_uses_and_what_covers_nothing_do_not_count) {
    Scene scene = random_triangles(10);
    const View alone = frame(scene, yfov, 1.0);
    scene.meshes[0].primitives[0].positions.emplace_back(100, 0, 0);
    scene.materials.push_back({.base_colour = vec4(1, 1, 1, 0), .alpha_mode = AlphaMode::blend});
    scene.materials.push_back({.base_colour = vec4(1, 1, 1, 0.4), .alpha_mode = AlphaMode::mask});
    for (std::size_t material : {1, 2}) {
        Primitive p = rectangle({50, 0, 0}, {0, 50, 0}).meshes[0].primitives[0];
        p.material = material;
        scene.meshes[0].primitives.push_back(p);
    }
    EXPECT_EQ(frame(scene, yfov, 1.0).eye, alone.eye);
    // Unless there is nothing else.
    scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin());
    expect_tight(scene, 1.0);
}

TEST(Framing, points_and_lines_are_framed_by_their_ends_before_they_are_drawn_and_after) {
    Scene scene = scene_of({});
    Random random;
    Primitive& p = scene.meshes[0].primitives[0];
    for (std::uint32_t i = 0; i < 50; ++i) {
        p.positions.push_back(random.point());
        p.strokes.emplace_back(i, i / 2);
    }
    expect_tight(scene, 1.5);
    const View view = frame(scene, yfov, 1.5);
    draw_strokes(scene, view, 100, 5.0);
    const View after = frame(scene, yfov, 1.5);
    EXPECT_EQ(after.eye, view.eye);
    EXPECT_EQ(after.focus_distance, view.focus_distance);
}

TEST(Framing, extremes_have_a_finite_view) {
    const auto stroke = [](const vec3& a, const vec3& b) {
        Scene scene = scene_of({});
        scene.meshes[0].primitives[0].positions = {a, b};
        scene.meshes[0].primitives[0].strokes = {{0, 1}};
        return scene;
    };
    for (const double aspect : {1.0, 1e-4, 1e4})
        for (const vec3& place : {vec3(0), vec3(3, -2, 1), vec3(-1e11, 1e11, 1e11)}) {
            SCOPED_TRACE(std::to_string(aspect) + " at " + std::to_string(place.x));
            expect_inside(stroke(place, place), aspect);                              // one point
            expect_inside(stroke(place, place + 100.0f * vec3(from_there)), aspect);  // a line seen end on
            expect_inside(stroke(place, -place), aspect);
        }
    expect_inside(rectangle(from_there, {1e-9, 0, 0}), 1.0);
}

TEST(Framing, a_smaller_angle_stands_farther_away) {
    const Scene scene = random_triangles(50);
    EXPECT_GT(glm::length(frame(scene, 0.01, 1.0).eye), 10 * glm::length(frame(scene, 1.0, 1.0).eye));
}

TEST(Framing, models_of_others_touch_the_margin) {
    const std::filesystem::path folder = test_assets();
    if (!std::filesystem::exists(folder / "MANIFEST.json")) GTEST_SKIP() << "no test models";
    const std::vector<std::uint8_t> text = read_file(folder / "MANIFEST.json");
    int framed = 0;
    for (const nlohmann::json& model : nlohmann::json::parse(text.begin(), text.end())) {
        const std::string entry = model["entry"];
        SCOPED_TRACE(entry);
        Scene scene;
        try {
            scene = load_gltf(folder / entry, {.max_texture = 16});
        } catch (const Error&) {
            continue;  // refused as it should be: assets_test.cpp
        }
        if (!scene.cameras.empty() || bounds_of(scene).empty()) continue;
        ++framed;
        for (const double aspect : {1.0, 16.0 / 9}) expect_tight(scene, aspect);
    }
    EXPECT_GT(framed, 90);
}

}  // namespace
}  // namespace triad
