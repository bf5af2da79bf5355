// Skins: vertices go where joints do, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"
#include "gltf_poses.h"

namespace triad {
namespace {

TEST(GltfSkin, joints_move_vertices_and_the_node_does_not) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, {1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0});
    b.document["nodes"][0]["translation"] = {100, 0, 0};
    b.document["nodes"][1]["translation"] = {0, 0, 10};
    b.document["nodes"][2]["translation"] = {0, 4, 0};
    const Scene scene = b.load();
    expect_vector(corner_of(scene, 0, 0), {0, 0, 10});
    expect_vector(corner_of(scene, 0, 1), {1, 2, 10});
    expect_vector(corner_of(scene, 0, 2), {0, 5, 10});
}

TEST(GltfSkin, inverse_bind_matrices_undo_the_pose_they_were_made_in) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, {1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    b.document["nodes"][2]["translation"] = {0, 4, 0};
    b.document["nodes"][2]["rotation"] = {0, 0, 1, 0};
    b.document["skins"][0]["inverseBindMatrices"] =
        b.accessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -4, 0, 1},
                   "MAT4");
    const Scene scene = b.load();
    expect_vector(corner_of(scene, 0, 0), {0, 0, 0});
    expect_vector(corner_of(scene, 0, 1), {-1, 4 + 4, 0});  // half a turn about (0, 4)
    b.document["skins"][0]["inverseBindMatrices"] =
        b.accessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
    EXPECT_NE(b.refusal().find("1 inverseBindMatrices for 2 joints"), std::string::npos) << b.refusal();
}

TEST(GltfSkin, targets_move_vertices_before_joints_do) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, all_to_first);
    b.document["nodes"][1]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
    b.primitive()["targets"] = {
        {{"POSITION", b.accessor(std::vector<float>{3, 0, 0, 3, 0, 0, 3, 0, 0}, "VEC3")}}};
    b.document["meshes"][0]["weights"] = {1};
    expect_vector(corner_of(b.load(), 0, 0), {0, 3, 0});
}

TEST(GltfSkin, weights_count_in_proportion_and_sets_add_up) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, {0.2f, 0, 0, 0, 0.2f, 0, 0, 0, 0.2f, 0, 0, 0});
    auto& attributes = b.primitive()["attributes"];
    attributes["JOINTS_1"] =
        b.accessor(std::vector<std::uint16_t>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] =
        b.accessor(std::vector<std::uint8_t>{51, 0, 0, 0, 51, 0, 0, 0, 51, 0, 0, 0}, "VEC4", true);
    b.document["nodes"][2]["translation"] = {0, 0, 8};
    expect_vector(corner_of(b.load(), 0, 1), {1, 0, 4});  // 0.2 and 51/255, half each
    EXPECT_TRUE(b.report.warnings.empty());
}

TEST(GltfSkin, vertices_that_nothing_moves_go_with_a_joint_and_are_reported_once) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
    b.document["nodes"][1]["translation"] = {5, 0, 0};
    expect_vector(corner_of(b.load(), 0, 0), {5, 0, 0});
    EXPECT_EQ(b.report.warnings.size(), 1u);
    EXPECT_TRUE(b.warned("no joint"));
}

TEST(GltfSkin, a_joint_that_the_skin_does_not_have_is_refused) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, all_to_first);
    b.document["skins"][0]["joints"] = {1};
    EXPECT_NE(b.refusal().find("names joint 1 of a skin that has 1"), std::string::npos) << b.refusal();
}

TEST(GltfSkin, normals_stay_upright_under_uneven_scale_and_fronts_stay_fronts_in_mirrors) {
    GltfBuilder b;
    with_normals(b);
    with_skin(b, all_to_first);
    b.primitive()["attributes"]["NORMAL"] = b.accessor(std::vector<float>{0, 1, 1, 0, 1, 1, 0, 1, 1}, "VEC3");
    b.document["nodes"][1]["scale"] = {-1, 2, 1};
    const Scene scene = b.load();
    const Primitive& p = scene.meshes[0].primitives[0];
    expect_vector(dvec3(p.normals[0]), glm::normalize(dvec3(0, 0.5, 1)));
    const uvec3 t = p.triangles.at(0);
    const dvec3 a = p.positions[t.x],
                front = glm::cross(dvec3(p.positions[t.y]) - a, dvec3(p.positions[t.z]) - a);
    EXPECT_GT(front.z, 0) << "as the triangle was bound";
}

TEST(GltfSkin, far_from_the_origin_a_mesh_keeps_its_shape) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, all_to_first);
    const double far = 1e6 + 0.015625;
    b.document["nodes"][1]["translation"] = {far, 0, 0};
    const Scene scene = b.load();
    EXPECT_LT(std::abs(corner_of(scene, 0, 1).x - corner_of(scene, 0, 0).x - 1), 1e-6);
    EXPECT_LT(std::abs(corner_of(scene, 0, 0).x - far), 1e-6);
}

TEST(GltfSkin, nodes_with_one_skin_share_its_mesh) {
    GltfBuilder b;
    b.triangle();
    with_skin(b, all_to_first);
    b.document["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    b.document["nodes"].push_back({{"mesh", 0}});
    b.document["scenes"][0]["nodes"] = {0, 1, 3, 4};
    b.document["nodes"][1]["translation"] = {5, 0, 0};
    const Scene scene = b.load();
    EXPECT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 2u);
    expect_vector(corner_of(scene, 2, 0), {0, 0, 0});
}

}  // namespace
}  // namespace triad
