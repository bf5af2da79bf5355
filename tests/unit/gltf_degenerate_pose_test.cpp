// Skins and morph targets that no author means: each becomes a defined pose of finite vertices, or a
// sentence.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_builder.h"
#include "gltf_poses.h"

namespace triad {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

void expect_finite(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) {
            for (const vec3& v : p.positions)
                for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(v[k]));
            for (const vec3& n : p.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
        }
}

/// One triangle, of whose morph target every vertex goes up by 1.
void with_target(GltfBuilder& b) {
    b.triangle();
    b.primitive()["targets"] = {
        {{"POSITION", b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
}

void animate_weights(GltfBuilder& b, std::size_t node, const std::vector<float>& values) {
    nlohmann::json& animation = b.document["animations"][0];
    animation["samplers"].push_back({{"input", b.accessor(std::vector<float>{0}, "SCALAR")},
                                     {"output", b.accessor(values, "SCALAR")},
                                     {"interpolation", "STEP"}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", "weights"}}}});
}

TEST(GltfDegeneratePose, weights_of_joints_that_are_no_numbers_or_negative_count_for_nothing) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, {nan, inf, -1, 0, nan, 0.5f, 0, 0, 0.25f, -inf, 0, 0});
    b.document["nodes"][1]["translation"] = {5, 0, 0};
    b.document["nodes"][2]["translation"] = {0, 7, 0};
    const Scene scene = b.load();
    expect_vector(corner_of(scene, 0, 0), {5, 0, 0});  // with its first joint: nothing else moves it
    expect_vector(corner_of(scene, 0, 1), {6, 7, 0});
    expect_vector(corner_of(scene, 0, 2), {5, 1, 0});
    EXPECT_TRUE(b.warned("no joint"));
    expect_finite(scene);
}

TEST(GltfDegeneratePose, weights_of_any_sum_count_in_proportion) {
    for (const float sum : {1e-30f, 0.3f, 1.0f, 7.0f, 1e30f}) {
        GltfBuilder b;
        b.triangle();
        with_skin(b, {sum, 0, 0, 0, sum, sum, 0, 0, sum, 3 * sum, 0, 0});
        b.document["nodes"][2]["translation"] = {0, 0, 8};
        const Scene scene = b.load();
        expect_vector(corner_of(scene, 0, 1), {1, 0, 4});
        expect_vector(corner_of(scene, 0, 2), {0, 1, 6});
    }
}

TEST(GltfDegeneratePose, a_joint_of_scale_0_draws_its_vertices_to_a_point) {
    GltfBuilder b;
    with_normals(b);
    with_skin(b, all_to_first);
    b.document["nodes"][1]["scale"] = {0, 0, 0};
    b.document["nodes"][1]["translation"] = {3, 0, 0};
    const Scene gone = b.load();
    EXPECT_TRUE(gone.meshes[0].primitives[0].triangles.empty());
    EXPECT_TRUE(b.warned("1 triangles without area"));
    expect_finite(gone);
    // a corner of its own stays where the other joint has it
    GltfBuilder half;
    with_normals(half);
    with_skin(half, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});
    half.primitive()["attributes"]["JOINTS_0"] =
        half.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    half.document["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"scale", {0, 0, 0}}}, nlohmann::json::object()};
    half.document["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = half.load();
    expect_vector(corner_of(scene, 0, 0), {0, 0, 0});
    expect_vector(corner_of(scene, 0, 1), {1, 0, 0});
    EXPECT_EQ(scene.meshes[0].primitives[0].triangles.size(), 1u);
    expect_finite(scene);
}

TEST(GltfDegeneratePose, a_flat_joint_keeps_normals) {
    GltfBuilder b;
    with_normals(b);
    with_skin(b, all_to_first);
    b.document["nodes"][1]["scale"] = {1, 1, 0};
    const Scene scene = b.load();
    expect_vector(dvec3(scene.meshes[0].primitives[0].normals[0]), {0, 0, 1});
    EXPECT_TRUE(b.report.warnings.empty());
}

TEST(GltfDegeneratePose, one_joint_in_all_places_is_a_joint) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, {0.5f, 0.5f, 0, 0, 0.2f, 0.3f, 0, 0, 0, 1, 0, 0});
    b.document["skins"][0]["joints"] = {2, 2};
    b.document["nodes"][2]["translation"] = {0, 0, 4};
    const Scene scene = b.load();
    for (std::size_t corner = 0; corner < 3; ++corner)
        EXPECT_NEAR(corner_of(scene, 0, corner).z, 4, 1e-6) << corner;
}

TEST(GltfDegeneratePose, inverse_bind_matrices_that_are_no_numbers_are_told_and_missing_ones_are_none) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, all_to_first);
    b.document["nodes"][1]["translation"] = {0, 0, 2};
    expect_vector(corner_of(b.load(), 0, 1), {1, 0, 2});
    std::vector<float> matrices(32, nan);
    for (int k = 0; k < 16; ++k) matrices[std::size_t(16 + k)] = k % 5 == 0;
    b.document["skins"][0]["inverseBindMatrices"] = b.accessor(matrices, "MAT4");
    expect_vector(corner_of(b.load(), 0, 1), {1, 0, 2});
    EXPECT_TRUE(
        b.warned("inverseBindMatrices (accessor 3) has 1 of 2 matrices with elements that are no finite"));
}

TEST(GltfDegeneratePose, a_joint_whose_transform_is_no_number_is_refused) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, all_to_first);
    nlohmann::json& animation = b.document["animations"][0];
    animation["samplers"] = {{{"input", b.accessor(std::vector<float>{0}, "SCALAR")},
                              {"output", b.accessor(std::vector<float>{1, nan, 1}, "VEC3")}}};
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "scale"}}}}};
    EXPECT_NE(b.refusal().find("no numbers"), std::string::npos) << b.refusal();
}

TEST(GltfDegeneratePose, weights_of_targets_that_are_no_numbers_are_told_and_count_for_nothing) {
    for (const float weight : {nan, inf}) {
        GltfBuilder b;
        with_target(b);
        b.document["nodes"].push_back({{"mesh", 0}, {"weights", {2}}});
        b.document["scenes"][0]["nodes"] = {0, 1};
        animate_weights(b, 0, {weight});
        const Scene scene = b.load();
        EXPECT_EQ(corner_of(scene, 0, 0).z, 0);
        EXPECT_EQ(corner_of(scene, 1, 0).z, 2) << "the pose of another node";
        EXPECT_TRUE(b.warned("node 0 has weights of morph targets that are no finite numbers"));
    }
}

TEST(GltfDegeneratePose, a_huge_weight_of_a_target_is_refused_by_name) {
    GltfBuilder b;
    with_target(b);
    b.document["meshes"][0]["weights"] = {1e30};
    EXPECT_NE(b.refusal().find("has a coordinate beyond"), std::string::npos) << b.refusal();
    b.document["meshes"][0]["weights"] = {1e300};
    std::string sentence = b.refusal();
    if (sentence.empty()) {  // beyond float: left out
        EXPECT_TRUE(b.load().meshes[0].primitives[0].triangles.empty());
        EXPECT_TRUE(b.warned("corners that are no numbers"));
    }
}

}  // namespace
}  // namespace triad
