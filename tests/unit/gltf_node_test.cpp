// Where things are: nodes, instances, lights, cameras; and where the bytes may come from.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "gltf_builder.h"
#include "gltf_files.h"

namespace triad {
namespace {

using nlohmann::json;

void expect_near(const dvec3& a, const dvec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-6) << a.x << " " << a.y << " " << a.z;
}

TEST(GltfNode, transforms_multiply_down_the_hierarchy) {
    GltfBuilder b;
    b.triangle().document["nodes"] = {
        {{"children", {1}},
         {"translation", {10, 0, 0}},
         {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}},
        {{"name", "leaf"}, {"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -2, 0, 1, 0, 0, 1}}}};
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "leaf");
    // Scaled by 2 and mirrored, moved 1 along x, turned a quarter about z, moved 10 along x.
    expect_near(transform_point(scene.instances[0].to_world, {1, 0, 0}), {10, 3, 0});
    expect_near(transform_point(scene.instances[0].to_world, {0, 0, 1}), {10, 1, -2});
    EXPECT_LT(glm::determinant(dmat3(scene.instances[0].to_world)), 0.0);
    expect_near(bounds_of(scene).lo, {8, 1, 0});
}

TEST(GltfNode, without_a_default_the_first_scene_is_taken_and_a_choice_is_honoured) {
    GltfBuilder b;
    b.triangle().document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {0, 1}}, {"name", "both"}}};
    b.document["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
    EXPECT_EQ(b.load().instances.size(), 1u);
    EXPECT_EQ(b.load({1}).instances.size(), 2u);
    b.document["scene"] = 1;
    EXPECT_EQ(b.load().name, "both");
    EXPECT_THROW(b.load({2}), Error);
}

TEST(GltfNode, hidden_nodes_hide_what_is_below_but_not_cameras) {
    GltfBuilder b;
    b.triangle().document["nodes"] = {
        {{"children", {1, 2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
        {{"mesh", 0}},
        {{"camera", 0}}};
    b.document["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", -1}, {"znear", 0}, {"zfar", 9}}}}};
    const Scene scene = b.load();
    EXPECT_TRUE(scene.instances.empty());
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].magnification, dvec2(2, 1));
}

TEST(GltfNode, instancing_places_the_mesh_once_per_element_and_not_by_itself) {
    GltfBuilder b;
    b.triangle();
    const auto t = b.accessor(std::vector<float>{1, 0, 0, 0, 2, 0}, "VEC3");
    const auto r = b.accessor(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", true);
    b.document["nodes"][0]["translation"] = {0, 0, 7};
    b.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t},
                                                                                     {"ROTATION", r}};
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 2u);
    expect_near(transform_point(scene.instances[0].to_world, {1, 0, 0}), {2, 0, 7});
    expect_near(transform_point(scene.instances[1].to_world, {1, 0, 0}), {-1, 2, 7});
}

TEST(GltfNode, instances_with_attributes_of_different_counts_are_refused) {
    GltfBuilder b;
    b.triangle();
    const auto t = b.accessor(std::vector<float>{1, 0, 0, 0, 2, 0}, "VEC3");
    const auto s = b.accessor(std::vector<float>{1, 1, 1}, "VEC3");
    b.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t},
                                                                                     {"SCALE", s}};
    EXPECT_NE(b.refusal().find("different counts"), std::string::npos) << b.refusal();
}

TEST(GltfNode, instances_without_extent_are_left_out_with_one_warning) {
    GltfBuilder b;
    b.triangle();
    const auto s = b.accessor(std::vector<float>{1, 0, 1, 2, 2, 2, 0, 0, 0}, "VEC3");
    b.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"SCALE", s}};
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    expect_near(transform_point(scene.instances[0].to_world, {1, 0, 0}), {2, 0, 0});
    EXPECT_EQ(b.report.warnings.size(), 1u);
}

TEST(GltfNode, a_million_instances_load_as_instances_of_one_mesh) {
    constexpr std::size_t count = 1'000'000;
    GltfBuilder b;
    b.triangle();
    std::vector<float> translations;
    for (std::size_t i = 0; i < count; ++i)
        translations.insert(translations.end(), {float(i % 1000), float(i / 1000), 0.0f});
    const auto t = b.accessor(translations, "VEC3");
    b.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t}};
    const Scene scene = b.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), count);
    EXPECT_LE(scene.instances.capacity(), count + 1);
    expect_near(dvec3(scene.instances.back().to_world[3]), {999, 999, 0});
}

TEST(GltfNode, lights_shine_along_their_node_and_scale_changes_nothing_else) {
    GltfBuilder b;
    b.triangle().document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"color", {1, 0.5, 0}},
         {"intensity", 10},
         {"range", 3},
         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
        {{"type", "directional"}, {"range", 3}}};
    const json up = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};  // -z becomes -x
    for (const int light : {0, 1})
        b.document["nodes"].push_back({{"name", "lamp"},
                                       {"rotation", up},
                                       {"scale", {2, 2, 2}},
                                       {"translation", {1, 2, 3}},
                                       {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    b.document["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = b.load();
    ASSERT_EQ(scene.lights.size(), 2u);
    const PunctualLight &spot = scene.lights[0], &sun = scene.lights[1];
    EXPECT_EQ(spot.name, "lamp");
    EXPECT_EQ(spot.colour, vec3(10, 5, 0));
    EXPECT_EQ(spot.range, 3.0f);
    EXPECT_FLOAT_EQ(spot.inner_cone, 0.1f);
    EXPECT_FLOAT_EQ(spot.outer_cone, 0.2f);
    expect_near(spot.position, {1, 2, 3});
    expect_near(spot.direction, {-1, 0, 0});
    EXPECT_EQ(sun.range, 0.0f) << "a directional light has no range";
    EXPECT_EQ(sun.colour, vec3(1));
}

TEST(GltfNode, a_camera_in_a_mirrored_and_scaled_node_stays_a_rotation) {
    GltfBuilder b;
    b.triangle().document["nodes"].push_back(
        {{"camera", 0}, {"scale", {-3, 2, 2}}, {"translation", {0, 0, 4}}});
    b.document["scenes"][0]["nodes"] = {0, 1};
    b.document["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    const SceneCamera camera = b.load().cameras.at(0);
    EXPECT_EQ(camera.name, "eye");
    EXPECT_EQ(camera.yfov, 0.5);
    EXPECT_EQ(camera.aspect, 0.0);
    EXPECT_NEAR(glm::determinant(dmat3(camera.to_world)), 1.0, 1e-12);
    expect_near(transform_vector(camera.to_world, {0, 0, -1}), {0, 0, -1});
    expect_near(dvec3(camera.to_world[3]), {0, 0, 4});
}

TEST(GltfNode, a_node_scaled_to_nothing_is_left_out) {
    GltfBuilder b;
    b.triangle().document["nodes"][0]["scale"] = {1, 0, 1};
    EXPECT_TRUE(b.load().instances.empty());
    EXPECT_TRUE(b.warned("scaled to nothing"));
}

TEST(GltfFile, names_with_signs_that_mean_something_in_uris_are_found) {
    for (const auto& [uri, name] : {std::pair{"a+b.bin", "a+b.bin"},
                                    {"a%20b.bin", "a b.bin"},
                                    {"a b.bin", "a b.bin"},
                                    {"%E2%9D%A4.bin", "❤.bin"},
                                    {"❤.bin", "❤.bin"},
                                    {"sub/./x.bin", "sub/x.bin"},
                                    {"100%.bin", "100%.bin"}}) {
        GltfBuilder b;
        b.triangle();
        std::filesystem::create_directories(b.folder / "sub");
        std::ofstream(b.folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(b.bytes.data()), 36);
        b.document["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        EXPECT_EQ(b.load_text(b.document.dump()).instances.size(), 1u) << uri;
    }
}

TEST(GltfFile, data_uris_of_every_form_are_data) {
    for (const char* uri :
         {"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
          "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
          "DATA:x/y;charset=utf-8;BASE64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
          "data:,%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80?%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80?"
          "%00%00%00%00"}) {
        GltfBuilder b;
        b.triangle().document["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        const Scene scene = b.load_text(b.document.dump());
        EXPECT_EQ(scene.meshes.at(0).primitives.at(0).positions.at(1), vec3(1, 0, 0)) << uri;
    }
}

TEST(GltfFile, nothing_outside_the_folder_is_opened) {
    GltfBuilder b;
    b.triangle();
    TemporaryFolder other;
    std::ofstream(other / "secret.bin") << std::string(36, 'x');
    std::filesystem::create_symlink(other / "secret.bin", b.folder / "link.bin");
    ASSERT_EQ(::mkfifo((b.folder / "fifo").c_str(), 0600), 0);
    for (const std::string& uri :
         {(other / "secret.bin").string(),
          "../" + (other / "x").parent_path().filename().string() + "/secret.bin", std::string("link.bin"),
          std::string("fifo"), std::string("."), std::string(""), std::string("http://localhost/x.bin"),
          std::string("file:///etc/hostname"), std::string("a%00.bin")}) {
        b.document["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        EXPECT_THROW(b.load_text(b.document.dump()), Error) << uri;
    }
}

TEST(GltfFile, a_missing_file_is_named) {
    try {
        load_gltf("/nowhere/at all.gltf");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.exit(), Exit::scene);
        EXPECT_NE(std::string(e.what()).find("/nowhere/at all.gltf"), std::string::npos);
    }
}

class GltfAssets : public testing::TestWithParam<const char*> {};

TEST_P(GltfAssets, load_and_are_valid) {
    const auto folder = test_assets() / GetParam();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
    for (const auto& file : gltf_files(folder)) {
        try {
            GltfReport report;
            Scene scene = load_gltf(file, {}, &report);
            EXPECT_EQ(validate(scene), 0u) << file;
            EXPECT_TRUE(!scene.instances.empty() || report.nodes == 0 ||
                        file.string().find("empty_scene") != std::string::npos)
                << file;
        } catch (const Error& e) {
            ADD_FAILURE() << e.what();
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Folders, GltfAssets, testing::Values("core", "textures", "ext-lights", "scenes"));

}  // namespace
}  // namespace triad
