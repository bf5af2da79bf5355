// Poses: animations between their key frames and morph targets, against closed forms; and variants.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"
#include "gltf_poses.h"

namespace triad {
namespace {

using nlohmann::json;

/// Animates `path` of a node.
void animate(GltfBuilder& b, std::size_t node, const char* path, const char* interpolation,
             const std::vector<float>& times, const std::vector<float>& values, const std::string& type) {
    json& animation = b.document["animations"][0];
    animation["samplers"].push_back({{"input", b.accessor(times, "SCALAR")},
                                     {"output", b.accessor(values, type)},
                                     {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

Scene at(GltfBuilder& b, double time, const std::string& animation = "") {
    return b.load({.animation = animation, .time = time});
}

TEST(GltfPose, steps_hold_and_lines_run_straight_and_stay_at_their_ends) {
    for (const char* interpolation : {"STEP", "LINEAR"}) {
        GltfBuilder b;
        b.triangle();
        animate(b, 0, "translation", interpolation, {1, 3}, {0, 0, 0, 4, 0, -8}, "VEC3");
        const bool steps = std::string(interpolation) == "STEP";
        expect_vector(corner_of(at(b, -5), 0, 0), {0, 0, 0});
        expect_vector(corner_of(at(b, 1.5), 0, 0), steps ? dvec3(0) : dvec3(1, 0, -2));
        expect_vector(corner_of(at(b, 3), 0, 0), {4, 0, -8});
        expect_vector(corner_of(at(b, 99), 0, 0), {4, 0, -8});
    }
}

TEST(GltfPose, cubic_splines_go_through_their_values_with_their_tangents) {
    // x = t^3 on [0, 2]: tangents 0 and 12, in one segment of 2 s.
    GltfBuilder b;
    b.triangle();
    animate(b, 0, "translation", "CUBICSPLINE", {0, 2},
            {9, 9, 9, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 9, 9, 9}, "VEC3");
    for (const double t : {0.0, 0.5, 1.0, 1.75, 2.0})
        expect_vector(corner_of(at(b, t), 0, 0), {t * t * t, 0, 0});
}

TEST(GltfPose, rotations_turn_evenly_and_the_short_way) {
    // From 0 to 90 degrees about z, the end given as the other quaternion of the same turn.
    const float h = std::sqrt(0.5f);
    GltfBuilder b;
    b.triangle();
    animate(b, 0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, -h, -h}, "VEC4");
    for (const double t : {0.0, 0.25, 0.5, 1.0})
        expect_vector(corner_of(at(b, t), 0, 1), {std::cos(t * pi / 2), std::sin(t * pi / 2), 0});
}

TEST(GltfPose, rotations_of_whole_numbers_are_normalised) {
    GltfBuilder b;
    b.triangle();
    animate(b, 0, "rotation", "LINEAR", {0}, {0, 0, 0, 1}, "VEC4");
    b.document["animations"][0]["samplers"][0]["output"] =
        b.accessor(std::vector<std::int16_t>{0, 0, 32767, 0}, "VEC4", true);
    expect_vector(corner_of(at(b, 0), 0, 1), {-1, 0, 0});
}

TEST(GltfPose, an_animation_is_chosen_by_name_or_index_and_none_leaves_nodes_as_they_are) {
    GltfBuilder b;
    b.triangle().document["nodes"][0]["translation"] = {7, 0, 0};
    animate(b, 0, "translation", "LINEAR", {0}, {1, 0, 0}, "VEC3");
    b.document["animations"][0]["name"] = "walk";
    b.document["animations"].push_back(b.document["animations"][0]);
    b.document["animations"][1]["name"] = "run";
    b.document["animations"][1]["samplers"][0]["output"] = b.accessor(std::vector<float>{2, 0, 0}, "VEC3");
    expect_vector(corner_of(at(b, 0), 0, 0), {1, 0, 0});
    expect_vector(corner_of(at(b, 0, "run"), 0, 0), {2, 0, 0});
    expect_vector(corner_of(at(b, 0, "1"), 0, 0), {2, 0, 0});
    expect_vector(corner_of(at(b, 0, "none"), 0, 0), {7, 0, 0});
    try {
        at(b, 0, "fly");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::usage);
        EXPECT_NE(std::string(error.what()).find("0 \"walk\", 1 \"run\""), std::string::npos) << error.what();
    }
}

TEST(GltfPose, key_frames_that_do_not_rise_or_do_not_fit_their_values_are_refused) {
    GltfBuilder b;
    b.triangle();
    animate(b, 0, "translation", "LINEAR", {1, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
    EXPECT_NE(b.refusal().find("not later"), std::string::npos) << b.refusal();
    GltfBuilder c;
    c.triangle();
    animate(c, 0, "translation", "CUBICSPLINE", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
    EXPECT_NE(c.refusal().find("has 2 values but needs 6"), std::string::npos) << c.refusal();
}

TEST(GltfPose, what_is_animated_outside_the_scene_changes_nothing_and_pointers_are_reported) {
    GltfBuilder b;
    b.triangle().document["nodes"].push_back({{"translation", {1, 1, 1}}});
    animate(b, 1, "translation", "LINEAR", {0}, {1, 0, 0}, "VEC3");
    json& channels = b.document["animations"][0]["channels"];
    channels.push_back(
        {{"sampler", 0},
         {"target",
          {{"path", "pointer"},
           {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/translation"}}}}}}}});
    b.document["extensionsUsed"] = {"KHR_animation_pointer"};
    expect_vector(corner_of(at(b, 0), 0, 1), {1, 0, 0});
    EXPECT_TRUE(b.warned("KHR_animation_pointer"));
}

TEST(GltfMorph, targets_add_up_by_their_weights_and_normals_keep_their_length) {
    GltfBuilder b;
    with_normals(b);
    const auto moved = b.accessor(std::vector<float>{0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3");
    const auto turned = b.accessor(std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3");
    b.primitive()["targets"] = {{{"POSITION", moved}, {"NORMAL", turned}}, {{"POSITION", turned}}};
    b.document["meshes"][0]["weights"] = {0.5, -1};
    const Scene scene = b.load();
    expect_vector(corner_of(scene, 0, 1), {-1, 0, 1});
    expect_vector(dvec3(scene.meshes[0].primitives[0].normals[0]), dvec3(std::sqrt(0.5), 0, std::sqrt(0.5)));
    EXPECT_TRUE(b.report.warnings.empty());
}

TEST(GltfMorph, an_animation_outdoes_the_node_and_the_node_its_mesh) {
    GltfBuilder b;
    b.triangle();
    b.primitive()["targets"] = {
        {{"POSITION", b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
    b.document["meshes"][0]["weights"] = {1};
    b.document["nodes"].push_back({{"mesh", 0}, {"weights", {2}}});
    b.document["nodes"].push_back({{"mesh", 0}, {"weights", {2}}});
    b.document["scenes"][0]["nodes"] = {0, 1, 2};
    animate(b, 2, "weights", "LINEAR", {0, 1}, {3, 5}, "SCALAR");
    const Scene scene = at(b, 0.5);
    EXPECT_EQ(corner_of(scene, 0, 0).z, 1);
    EXPECT_EQ(corner_of(scene, 1, 0).z, 2);
    EXPECT_EQ(corner_of(scene, 2, 0).z, 4);
    EXPECT_EQ(scene.meshes.size(), 3u);
}

TEST(GltfMorph, equal_poses_share_one_mesh) {
    GltfBuilder b;
    b.triangle();
    b.primitive()["targets"] = {
        {{"POSITION", b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
    b.document["nodes"] = {{{"mesh", 0}, {"weights", {1}}}, {{"mesh", 0}, {"weights", {1}}}};
    b.document["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(b.load().meshes.size(), 1u);
}

TEST(GltfMorph, sparse_and_quantised_targets_are_read) {
    GltfBuilder b;
    b.triangle().document["extensionsUsed"] = {"KHR_mesh_quantization"};
    const auto sparse = b.view(std::vector<std::uint16_t>{2});
    const auto values = b.view(std::vector<float>{0, 0, 6});
    b.document["accessors"].push_back({{"componentType", 5126},
                                       {"count", 3},
                                       {"type", "VEC3"},
                                       {"sparse",
                                        {{"count", 1},
                                         {"indices", {{"bufferView", sparse}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", values}}}}}});
    const std::size_t first = b.document["accessors"].size() - 1;
    const auto second = b.accessor(std::vector<std::int8_t>{127, 0, 0, 0, 0, 0, -127, 0, 0}, "VEC3", true);
    b.primitive()["targets"] = {{{"POSITION", first}}, {{"POSITION", second}}};
    b.document["meshes"][0]["weights"] = {0.5, 2};
    const Scene scene = b.load();
    expect_vector(corner_of(scene, 0, 0), {2, 0, 0});
    expect_vector(corner_of(scene, 0, 2), {-2, 1, 3});
}

TEST(GltfMorph, a_target_of_another_length_is_refused_by_name) {
    GltfBuilder b;
    b.triangle();
    b.primitive()["targets"] = {{{"POSITION", b.accessor(std::vector<float>{0, 0, 1}, "VEC3")}}};
    EXPECT_NE(b.refusal().find("morph target 0: POSITION has 1 elements"), std::string::npos) << b.refusal();
}

TEST(GltfVariants, a_variant_changes_what_it_maps_and_nothing_else) {
    GltfBuilder b;
    b.triangle().document["materials"] = {{{"name", "own"}}, {{"name", "red"}}};
    b.document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "dull"}}, {{"name", "hot"}}};
    b.primitive()["material"] = 0;
    b.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {1}}}};
    const auto name = [&](const std::string& variant) {
        const Scene scene = b.load({.variant = variant});
        return scene.materials.at(scene.meshes.at(0).primitives.at(0).material).name;
    };
    EXPECT_EQ(name(""), "own");
    EXPECT_EQ(name("dull"), "own");
    EXPECT_EQ(name("hot"), "red");
    try {
        name("cold");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::usage);
        EXPECT_NE(std::string(error.what()).find("\"dull\", \"hot\""), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace triad
