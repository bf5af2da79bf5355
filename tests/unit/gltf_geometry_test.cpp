// What glTF can say about triangles, and what it must not be allowed to say.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_builder.h"

namespace triad {
namespace {

using Floats = std::vector<float>;

const Primitive& only_primitive(const Scene& scene) { return scene.meshes.at(0).primitives.at(0); }

TEST(GltfGeometry, triangle_without_indices_has_flat_normals_and_the_default_material) {
    GltfBuilder b;
    const Scene scene = b.triangle().load();
    const Primitive& p = only_primitive(scene);
    EXPECT_EQ(p.triangles, (std::vector<uvec3>{{0, 1, 2}}));
    EXPECT_EQ(p.positions[1], vec3(1, 0, 0));
    EXPECT_TRUE(p.normals.empty());
    EXPECT_EQ(scene.materials.at(p.material).base_colour, vec4(1));
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(b.report.warnings.empty());
}

TEST(GltfGeometry, strips_and_fans_keep_their_winding) {
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        b.primitive()["attributes"]["POSITION"] =
            b.accessor(Floats{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5f, 0, 2, 1}, "VEC3");
        b.primitive()["mode"] = mode;
        const std::vector<uvec3> strip{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}, fan{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}};
        EXPECT_EQ(only_primitive(b.load()).triangles, mode == 5 ? strip : fan);
    }
}

TEST(GltfGeometry, indices_of_every_width_are_read) {
    const auto check = [](auto sample) {
        GltfBuilder b;
        b.triangle().primitive()["indices"] = b.accessor(std::vector<decltype(sample)>{2, 0, 1}, "SCALAR");
        EXPECT_EQ(only_primitive(b.load()).triangles, (std::vector<uvec3>{{2, 0, 1}}));
    };
    check(std::uint8_t());
    check(std::uint16_t());
    check(std::uint32_t());
}

TEST(GltfGeometry, interleaved_attributes_are_told_apart) {
    GltfBuilder b;
    const std::size_t view = b.view(Floats{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 2});
    b.document["bufferViews"][view]["byteStride"] = 24;
    for (const int offset : {0, 12})
        b.document["accessors"].push_back({{"bufferView", view},
                                           {"byteOffset", offset},
                                           {"componentType", 5126},
                                           {"count", 3},
                                           {"type", "VEC3"}});
    b.primitive()["attributes"] = {{"POSITION", 0}, {"NORMAL", 1}};
    const Scene scene = b.load();
    EXPECT_EQ(only_primitive(scene).positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(only_primitive(scene).normals[2], vec3(0, 0, 1)) << "normals are made unit";
}

TEST(GltfGeometry, sparse_values_replace_and_a_missing_view_means_zeros) {
    for (const bool has_view : {true, false}) {
        GltfBuilder b;
        b.triangle();
        const std::size_t indices = b.view(std::vector<std::uint16_t>{1, 2});
        const std::size_t values = b.view(Floats{5, 0, 0, 0, 7, 0});
        auto& accessor = b.document["accessors"][0];
        accessor["sparse"] = {{"count", 2},
                              {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                              {"values", {{"bufferView", values}}}};
        if (!has_view) accessor.erase("bufferView");
        EXPECT_EQ(only_primitive(b.load()).positions, (std::vector<vec3>{{0, 0, 0}, {5, 0, 0}, {0, 7, 0}}));
    }
}

TEST(GltfGeometry, quantised_positions_need_their_extension) {
    GltfBuilder b;
    b.primitive()["attributes"]["POSITION"] =
        b.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, -32768, 0}, "VEC3", true);
    EXPECT_NE(b.refusal().find("KHR_mesh_quantization"), std::string::npos);
    b.document["extensionsUsed"] = b.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(only_primitive(b.load()).positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
}

TEST(GltfGeometry, colours_of_every_type_become_rgba) {
    const auto check = [](auto one, const std::string& type, bool normalised) {
        GltfBuilder b;
        std::vector<decltype(one)> data;
        for (int v = 0; v < 3; ++v)
            for (int k = 0; k < type[3] - '0'; ++k) data.push_back(k == 0 ? one : 0);
        b.triangle().primitive()["attributes"]["COLOR_0"] = b.accessor(data, type, normalised);
        EXPECT_EQ(only_primitive(b.load()).colours[1], vec4(1, 0, 0, type == "VEC3" ? 1 : 0)) << type;
    };
    for (const char* type : {"VEC3", "VEC4"}) {
        check(1.0f, type, false);
        check(std::uint8_t(255), type, true);
        check(std::uint16_t(65535), type, true);
    }
}

TEST(GltfGeometry, two_uv_sets_are_read_and_a_third_is_reported) {
    GltfBuilder b;
    b.triangle();
    for (int set = 0; set < 3; ++set)
        b.primitive()["attributes"]["TEXCOORD_" + std::to_string(set)] =
            b.accessor(std::vector<std::uint8_t>{0, 0, 255, std::uint8_t(set * 51), 0, 255}, "VEC2", true);
    // Two bytes apart is less than the alignment that glTF asks for, but it is unambiguous.
    const Scene scene = b.load();
    EXPECT_EQ(only_primitive(scene).uvs[0][1], vec2(1, 0));
    EXPECT_FLOAT_EQ(only_primitive(scene).uvs[1][1].y, 0.2f);
    EXPECT_TRUE(b.warned("TEXCOORD_2"));
}

TEST(GltfGeometry, corners_that_are_no_numbers_and_triangles_without_area_are_left_out) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    GltfBuilder b;
    b.primitive()["attributes"]["POSITION"] = b.accessor(
        Floats{0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2}, "VEC3");
    const Scene scene = b.load();
    EXPECT_EQ(only_primitive(scene).triangles, (std::vector<uvec3>{{0, 1, 2}}));
    EXPECT_TRUE(b.warned("2 triangles"));
    for (const vec3& p : only_primitive(scene).positions) EXPECT_FALSE(std::isnan(p.x));
}

TEST(GltfGeometry, normals_without_length_become_those_of_their_triangles) {
    GltfBuilder b;
    b.triangle().primitive()["attributes"]["NORMAL"] =
        b.accessor(Floats{0, 0, 0, 0, 3, 4, NAN, 0, 0}, "VEC3");
    const Scene scene = b.load();
    EXPECT_EQ(only_primitive(scene).normals, (std::vector<vec3>{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}}));
}

TEST(GltfGeometry, points_and_lines_become_strokes) {
    const auto strokes = [](int mode) {
        GltfBuilder b;
        b.triangle().primitive()["mode"] = mode;
        const Scene scene = b.load();
        const Primitive& p = only_primitive(scene);
        EXPECT_TRUE(p.triangles.empty());
        EXPECT_TRUE(scene.materials[p.material].unlit) << "it has no normals";
        return p.strokes;
    };
    EXPECT_EQ(strokes(0), (std::vector<uvec2>{{0, 0}, {1, 1}, {2, 2}}));
    EXPECT_EQ(strokes(1), (std::vector<uvec2>{{0, 1}}));
    EXPECT_EQ(strokes(2), (std::vector<uvec2>{{0, 1}, {1, 2}, {2, 0}}));
    EXPECT_EQ(strokes(3), (std::vector<uvec2>{{0, 1}, {1, 2}}));
}

TEST(GltfGeometry, strokes_with_normals_are_lit_and_emission_without_adds_up) {
    GltfBuilder b;
    b.triangle().primitive()["mode"] = 0;
    b.document["materials"] = {
        {{"emissiveFactor", {0, 1, 0}}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0, 0, 1}}}}}};
    b.primitive()["material"] = 0;
    const Scene bare = b.load();
    EXPECT_EQ(bare.materials[only_primitive(bare).material].emission, vec3(0.5f, 1, 0));
    b.primitive()["attributes"]["NORMAL"] = b.accessor(Floats{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const Scene lit = b.load();
    EXPECT_FALSE(lit.materials[only_primitive(lit).material].unlit);
    EXPECT_EQ(lit.materials[only_primitive(lit).material].emission, vec3(0, 1, 0));
}

TEST(GltfGeometry, attributes_of_different_lengths_are_refused_by_name) {
    GltfBuilder b;
    b.triangle().primitive()["attributes"]["NORMAL"] = b.accessor(Floats{0, 0, 1}, "VEC3");
    b.document["meshes"][0]["name"] = "wheel";
    EXPECT_NE(b.refusal().find("mesh 0 'wheel', primitive 0: NORMAL"), std::string::npos) << b.refusal();
}

TEST(GltfGeometry, an_accessor_beyond_its_view_is_refused_with_both_sizes) {
    GltfBuilder b;
    b.triangle().document["accessors"][0]["count"] = 100;
    const std::string sentence = b.refusal();
    for (const char* part :
         {"mesh 0, primitive 0: POSITION (accessor 0)", "100 elements of 12 bytes", "36 bytes"})
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

TEST(GltfGeometry, zeros_without_a_buffer_are_no_way_to_fill_the_memory) {
    GltfBuilder b;
    b.triangle().document["accessors"][0]["count"] = 4000000000u;
    b.document["accessors"][0].erase("bufferView");
    EXPECT_NE(b.refusal().find("memory"), std::string::npos);
}

TEST(GltfGeometry, one_buffer_read_a_thousand_times_is_no_way_to_fill_the_memory) {
    GltfBuilder b;
    b.primitive()["attributes"]["POSITION"] = b.accessor(Floats(300000, 1.0f), "VEC3");
    for (int i = 1; i < 1000; ++i) b.primitive(std::size_t(i)) = b.primitive();
    EXPECT_NE(b.refusal().find("memory"), std::string::npos);
}

}  // namespace
}  // namespace triad
