// Huge triangles beside the eye: cut without cracks, area or order lost.
#include "pack/refine.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "scene/shapes.h"

using namespace triad;

namespace {

using Point = std::array<double, 3>;
Point point(const dvec3& v) { return {v.x, v.y, v.z}; }

std::vector<dvec3> positions_of(const Primitive& p) { return {p.positions.begin(), p.positions.end()}; }

double area(const std::vector<dvec3>& v, const uvec3& t) {
    return 0.5 * glm::length(glm::cross(v[t.y] - v[t.x], v[t.z] - v[t.x]));
}

/// A closed box of 2000 around an eye that is 0.1 above its floor.
constexpr double half = 1000;
const dvec3 eye(1.3, -half + 0.1, 0.7);
Primitive room() { return shapes::box(vec3(-half), vec3(half), true); }

TEST(Refine, leaves_what_is_small_beside_its_distance) {
    const Primitive p = shapes::box(vec3(-1), vec3(1));
    EXPECT_FALSE(needs_refining(p, positions_of(p), {0, 0, 1.2}, 1.0));
    EXPECT_TRUE(needs_refining(p, positions_of(p), {0, 0, 1.01}, 1.0));
}

TEST(Refine, opens_no_cracks_and_keeps_area_and_winding) {
    Primitive p = room();
    std::vector<dvec3> v = positions_of(p);
    double before = 0, after = 0;
    for (const uvec3& t : p.triangles) before += area(v, t);
    refine(p, v, eye, half);
    EXPECT_GT(p.triangles.size(), 50u);
    EXPECT_LT(p.triangles.size(), 1000u);
    // A closed surface: every directed edge has its opposite, exactly once.
    std::map<std::pair<Point, Point>, int> edges;
    for (const uvec3& t : p.triangles) {
        after += area(v, t);
        EXPECT_GT(area(v, t), 0);
        for (int i = 0; i < 3; ++i) ++edges[{point(v[t[i]]), point(v[t[(i + 1) % 3]])}];
    }
    EXPECT_NEAR(after, before, 1e-9 * before);
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
}

TEST(Refine, leaves_no_edge_longer_than_32_distances) {
    Primitive p = room();
    std::vector<dvec3> v = positions_of(p);
    refine(p, v, eye, half);
    for (const uvec3& t : p.triangles)
        for (int i = 0; i < 3; ++i) {
            const dvec3 a = v[t[i]], b = v[t[(i + 1) % 3]];
            const double along = std::clamp(glm::dot(eye - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
            EXPECT_LE(glm::length(b - a), 32.001 * glm::length(a + along * (b - a) - eye));
        }
}

TEST(Refine, ends_where_the_eye_lies_on_an_edge) {
    Primitive p = room();
    std::vector<dvec3> v = positions_of(p);
    refine(p, v, {-half, -half, 0}, half);
    EXPECT_LT(p.triangles.size(), 5000u);
}

TEST(Refine, cuts_duplicates_alike_whatever_their_first_corner) {
    const auto parts = [](const uvec3& triangle) {
        Primitive p = shapes::quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
        p.triangles = {triangle};
        std::vector<dvec3> v = positions_of(p);
        refine(p, v, {10, 0.1, 30}, half);
        std::set<std::set<Point>> result;
        for (const uvec3& t : p.triangles) result.insert({point(v[t.x]), point(v[t.y]), point(v[t.z])});
        return result;
    };
    EXPECT_GT(parts({0, 1, 2}).size(), 5u);
    EXPECT_EQ(parts({0, 1, 2}), parts({1, 2, 0}));
    EXPECT_EQ(parts({0, 1, 2}), parts({2, 1, 0}));
}

TEST(Refine, attributes_are_as_long_as_positions_and_linear) {
    Primitive p = shapes::quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
    p.normals.assign(p.positions.size(), vec3(0, 1, 0));
    p.tangents.assign(p.positions.size(), vec4(1, 0, 0, -1));
    std::vector<dvec3> v = positions_of(p);
    refine(p, v, {10, 0.1, 30}, half);
    ASSERT_EQ(p.uvs[0].size(), v.size());
    ASSERT_EQ(p.normals.size(), v.size());
    ASSERT_EQ(p.tangents.size(), v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
        EXPECT_NEAR(p.uvs[0][i].x, v[i].x / (2 * half) + 0.5, 1e-6);
        EXPECT_EQ(p.normals[i], vec3(0, 1, 0));
        EXPECT_EQ(p.tangents[i], vec4(1, 0, 0, -1));
    }
}

}  // namespace
