// Tangent frames: MikkTSpace's promises, known frames, and agreement with tangents that other tools stored.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gltf_builder.h"
#include "scene/tangents.h"
#include "test_assets.h"

namespace triad {
namespace {

/// A latitude-longitude sphere; u runs with the angle about y, v down from the pole. `mirror`: u runs the
/// other way.
Primitive uv_sphere(int rings, int sectors, bool mirror) {
    Primitive p;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j <= sectors; ++j) {
            const double theta = pi * i / rings, phi = 2 * pi * j / sectors;
            const vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            p.positions.push_back(n);
            p.normals.push_back(glm::normalize(n));
            p.uvs[0].emplace_back(float(mirror ? sectors - j : j) / float(sectors), float(i) / float(rings));
        }
    }
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sectors; ++j) {
            const unsigned a = unsigned(i * (sectors + 1) + j), b = a + unsigned(sectors) + 1;
            if (i > 0) p.triangles.emplace_back(a, b, a + 1);
            if (i < rings - 1) p.triangles.emplace_back(a + 1, b, b + 1);
        }
    }
    return p;
}

void expect_frames(const Primitive& p) {
    ASSERT_EQ(p.tangents.size(), p.positions.size());
    ASSERT_EQ(p.normals.size(), p.positions.size());
    for (std::size_t i = 0; i < p.tangents.size(); ++i) {
        EXPECT_NEAR(glm::length(vec3(p.tangents[i])), 1.0f, 1e-5f);
        EXPECT_EQ(std::abs(p.tangents[i].w), 1.0f);
    }
    for (const uvec3& t : p.triangles)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(glm::dot(vec3(p.tangents[t[k]]), p.normals[t[k]]), 0.0f, 1e-5f);
}

TEST(GltfTangents, on_a_sphere_they_run_along_the_parallels) {
    for (const bool mirror : {false, true}) {
        Primitive p = uv_sphere(32, 64, mirror);
        const std::size_t vertices = p.positions.size();
        generate_tangents(p, p.uvs[0]);
        EXPECT_EQ(p.positions.size(), vertices) << "no vertex needs two tangents";
        expect_frames(p);
        for (const uvec3& t : p.triangles) {
            for (int k = 0; k < 3; ++k) {
                const vec3 n = p.normals[t[k]];
                if (std::abs(n.y) > 0.9f) continue;
                const vec3 east = glm::normalize(glm::cross(vec3(0, 1, 0), n)) * (mirror ? -1.0f : 1.0f);
                EXPECT_GT(glm::dot(vec3(p.tangents[t[k]]), east), 0.995f);
                // v falls towards the upper pole, so the bitangent points there.
                EXPECT_GT((glm::cross(n, vec3(p.tangents[t[k]])) * p.tangents[t[k]].w).y, 0.0f);
                EXPECT_EQ(p.tangents[t[k]].w, mirror ? -1.0f : 1.0f);
            }
        }
    }
}

TEST(GltfTangents, do_not_depend_on_how_the_mesh_was_welded) {
    Primitive welded = uv_sphere(8, 12, false), unwelded;
    for (const uvec3& t : welded.triangles) {
        const unsigned first = unsigned(unwelded.positions.size());
        for (int k = 0; k < 3; ++k) {
            unwelded.positions.push_back(welded.positions[t[k]]);
            unwelded.normals.push_back(welded.normals[t[k]]);
            unwelded.uvs[0].push_back(welded.uvs[0][t[k]]);
        }
        unwelded.triangles.emplace_back(first, first + 1, first + 2);
    }
    generate_tangents(welded, welded.uvs[0]);
    generate_tangents(unwelded, unwelded.uvs[0]);
    ASSERT_EQ(welded.triangles.size(), unwelded.triangles.size());
    for (std::size_t f = 0; f < welded.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(welded.tangents[welded.triangles[f][k]], unwelded.tangents[unwelded.triangles[f][k]]);
}

TEST(GltfTangents, a_vertex_on_a_mirror_seam_is_split) {
    // Two quads beside each other whose u runs away from the common edge on both sides.
    Primitive p;
    for (const float x : {-1.0f, 0.0f, 1.0f})
        for (const float y : {0.0f, 1.0f}) {
            p.positions.emplace_back(x, y, 0);
            p.normals.emplace_back(0, 0, 1);
            p.uvs[0].emplace_back(std::abs(x), 1 - y);
            p.colours.emplace_back(x, y, 0, 1);
        }
    p.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
    generate_tangents(p, p.uvs[0]);
    expect_frames(p);
    EXPECT_EQ(p.positions.size(), 8u) << "both vertices of the seam twice";
    EXPECT_EQ(p.colours.size(), 8u);
    for (std::size_t f = 0; f < 4; ++f) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(p.tangents[p.triangles[f][k]], f < 2 ? vec4(-1, 0, 0, -1) : vec4(1, 0, 0, 1));
            EXPECT_EQ(p.positions[p.triangles[f][k]].x, p.colours[p.triangles[f][k]].x)
                << "attributes stay together";
        }
    }
}

TEST(GltfTangents, degenerate_triangles_and_uvs_disturb_nobody) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}, {NAN, 0, 0}};
    p.normals.assign(8, vec3(0, 0, 1));
    p.uvs[0] = {{0, 1}, {1, 1}, {0, 0}, {1, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
    // A good pair, one without area, one without a uv gradient, one with a corner that is no number.
    p.triangles = {{0, 1, 2}, {2, 1, 3}, {1, 1, 3}, {4, 5, 6}, {0, 7, 2}};
    generate_tangents(p, p.uvs[0]);
    expect_frames(p);
    for (int f = 0; f < 2; ++f)
        for (int k = 0; k < 3; ++k) EXPECT_EQ(p.tangents[p.triangles[std::size_t(f)][k]], vec4(1, 0, 0, 1));
}

TEST(GltfTangents, flat_meshes_get_a_vertex_per_corner) {
    GltfBuilder b;
    b.triangle().texture().document["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    b.primitive()["material"] = 0;
    b.primitive()["attributes"]["TEXCOORD_0"] = b.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
    const Scene scene = b.load();
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.normals, std::vector<vec3>(3, vec3(0, 0, 1)));
    EXPECT_EQ(p.tangents, std::vector<vec4>(3, vec4(1, 0, 0, 1)));
}

TEST(GltfTangents, agree_with_those_that_exporters_stored) {
    // FlightHelmet stores its tangents.
    const auto file = test_assets() / "scenes/FlightHelmet/FlightHelmet.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
    std::size_t same = 0, same_sign = 0, all = 0;
    for (const Mesh& mesh : load_gltf(file).meshes) {
        for (const Primitive& stored : mesh.primitives) {
            if (stored.tangents.empty()) continue;
            Primitive again = stored;
            generate_tangents(again, again.uvs[0]);
            for (std::size_t f = 0; f < stored.triangles.size(); ++f)
                for (int k = 0; k < 3; ++k) {
                    const vec4 a = stored.tangents[stored.triangles[f][k]],
                               b = again.tangents[again.triangles[f][k]];
                    ++all;
                    same_sign += a.w == b.w;
                    same += glm::dot(vec3(a), vec3(b)) > 0.99f;
                }
        }
    }
    ASSERT_GT(all, 100000u);
    EXPECT_GT(double(same_sign) / double(all), 0.99);
    EXPECT_GT(double(same) / double(all), 0.95);
}

}  // namespace
}  // namespace triad
