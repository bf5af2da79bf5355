// Damaged data of a scene are told, one warning for each that names the image or the accessor, and refused
// where that is asked for; what is valid is read however much of it there is; large images meet the memory
// limit before they are decoded.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "base/memory_limit.h"
#include "gltf_builder.h"
#include "program.h"
#include "synthetic_film.h"
#include "tiny_png.h"

using namespace triad;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();

/// The triangle, with this attribute.
GltfBuilder& with(GltfBuilder& b, const char* attribute, const std::vector<float>& values,
                  const std::string& type) {
    b.triangle().primitive()["attributes"][attribute] = b.accessor(values, type);
    return b;
}

/// One warning, counted as a fault, that holds `names`; an error by --strict.
void expect_one_fault(GltfBuilder& b, const std::string& names) {
    b.load();
    ASSERT_EQ(b.report.faults.size(), 1u) << names;
    EXPECT_EQ(b.report.warnings, b.report.faults);
    EXPECT_NE(b.report.faults[0].find(names), std::string::npos) << b.report.faults[0];
    try {
        b.load({.strict = true});
        ADD_FAILURE() << names;
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::scene);
        EXPECT_NE(std::string(error.what()).find(names), std::string::npos) << error.what();
    }
}

/// A JPEG of noise.
std::vector<std::uint8_t> jpeg() {
    EncodedPicture picture{64, 64, 3, 8, std::vector<std::uint8_t>(64 * 64 * 3), {}};
    for (std::size_t i = 0; i < picture.bytes.size(); ++i)
        picture.bytes[i] = std::uint8_t(i * 2654435761u >> 24);
    return encode_picture(".jpg", picture);
}

/// The triangle with this file as its base colour.
GltfBuilder& with_image(GltfBuilder& b, const std::vector<std::uint8_t>& file,
                        const char* member = "baseColorTexture") {
    b.triangle().primitive()["material"] = 0;
    b.document["materials"] = {{{"pbrMetallicRoughness", {{member, {{"index", 0}}}}}}};
    b.document["textures"] = {{{"source", 0}}};
    b.document["images"] = {{{"bufferView", b.view(file)}, {"name", "bark"}}};
    return b;
}

/// width x height pixels of one colour, 8-bit RGB.
std::vector<std::uint8_t> png(unsigned width, unsigned height, std::uint8_t grey = 100) {
    EncodedPicture picture{
        width, height, 3, 8, std::vector<std::uint8_t>(std::size_t(width) * height * 3, grey), {}};
    return encode_picture(".png", picture);
}

}  // namespace

TEST(GltfFault, attributes_that_are_no_numbers_are_told) {
    for (const float bad : {not_a_number, infinite, -infinite}) {
        GltfBuilder normal, uv, colour, position;
        expect_one_fault(with(normal, "NORMAL", {0, 0, 1, 0, bad, 1, 0, 0, 1}, "VEC3"),
                         "mesh 0, primitive 0: NORMAL (accessor 0) has 1 of 3 elements");
        expect_one_fault(with(uv, "TEXCOORD_0", {0, 0, bad, 1, 1, bad}, "VEC2"),
                         "mesh 0, primitive 0: TEXCOORD_0 (accessor 0) has 2 of 3 elements");
        expect_one_fault(with(colour, "COLOR_0", {1, 1, 1, 1, bad, 1, 1, 1, 1}, "VEC3"),
                         "mesh 0, primitive 0: COLOR_0 (accessor 0) has 1 of 3 elements");
    }
}

TEST(GltfFault, normals_without_length_are_told) {
    GltfBuilder b;
    expect_one_fault(with(b, "NORMAL", {0, 0, 1, 0, 0, 0, 0, 0, 1}, "VEC3"),
                     "NORMAL (accessor 0) has 1 of 3 elements");
}

TEST(GltfFault, corners_that_are_no_numbers_are_told_with_their_accessor) {
    GltfBuilder b;
    b.primitive()["attributes"]["POSITION"] = b.accessor(
        std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, not_a_number, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    EXPECT_EQ(b.load().meshes[0].primitives[0].triangles.size(), 1u);
    ASSERT_EQ(b.report.faults.size(), 1u);
    EXPECT_NE(b.report.faults[0].find("POSITION (accessor 0) has 1 of 6 elements"), std::string::npos);
}

TEST(GltfFault, a_jpeg_that_is_cut_off_is_told) {
    const std::vector<std::uint8_t> whole = jpeg();
    GltfBuilder good;
    with_image(good, whole).load();
    EXPECT_TRUE(good.report.warnings.empty());
    for (const std::size_t left : {whole.size() / 2, whole.size() - 2}) {
        GltfBuilder b;
        expect_one_fault(with_image(b, {whole.begin(), whole.begin() + std::ptrdiff_t(left)}),
                         "image 0 'bark'");
    }
}

TEST(GltfFault, a_jpeg_whose_bits_flipped_is_told_as_far_as_its_decoder_sees_it) {
    std::vector<std::uint8_t> file = jpeg();
    file[file.size() / 2] = 0xff, file[file.size() / 2 + 1] = 0xd3;  // a marker where none can be
    GltfBuilder b;
    expect_one_fault(with_image(b, file), "image 0 'bark'");
}

TEST(GltfFault, strict_is_an_option_of_render_and_info) {
    GltfBuilder b;
    with(b, "NORMAL", {0, 0, 1, 0, 0, 0, 0, 0, 1}, "VEC3").load();
    const std::string file = "'" + (b.folder / "scene.gltf").string() + "'";
    const Outcome info = run_triad("info " + file);
    EXPECT_EQ(info.exit, 0);
    EXPECT_NE(info.output.find("faults      1"), std::string::npos) << info.output;
    for (const std::string command : {"info ", "render "}) {
        const Outcome outcome = run_triad(command + file + " --strict");
        EXPECT_EQ(outcome.exit, 2) << outcome.output;
        EXPECT_NE(outcome.output.find("without length"), std::string::npos) << outcome.output;
    }
}

TEST(GltfFault, files_of_other_kinds_are_told_for_what_they_are_not) {
    const GltfBuilder b;
    const std::string picture(reinterpret_cast<const char*>(png(1, 1).data()), 16);
    for (const std::string& text :
         {picture, std::string("# Blender\nmtllib a.mtl\n"), std::string("\xff\xd8\xff")}) {
        const std::filesystem::path file = b.folder / "other.glb";
        std::ofstream(file, std::ios::binary) << text;
        const Outcome info = run_triad("info '" + file.string() + "'");
        EXPECT_EQ(info.exit, 2);
        EXPECT_NE(info.output.find("not glTF"), std::string::npos) << info.output;
    }
}

TEST(GltfFault, files_without_a_byte_or_without_json_are_told_in_plain_words) {
    const GltfBuilder b;
    const std::string file = (b.folder / "a.gltf").string();
    std::ofstream(file).flush();
    for (const std::string command : {"info ", "render "})
        EXPECT_NE(run_triad(command + file).output.find("triad: " + file + " is empty."), std::string::npos);
    std::ofstream(file) << "{\"asset\": ";
    const Outcome info = run_triad("info " + file);
    EXPECT_EQ(info.exit, 2);
    EXPECT_NE(info.output.find("The file is not valid JSON: parse error at line 1"), std::string::npos)
        << info.output;
}

TEST(GltfFault, a_film_is_told_for_what_it_is) {
    const GltfBuilder b;
    const std::string film = (b.folder / "a.film").string();
    triad::save_film(film, synthetic({0, 4}));
    const Outcome outcome = run_triad("render " + film + " -o " + (b.folder / "y.png").string());
    EXPECT_EQ(outcome.exit, 2);
    for (const std::string& words :
         {film + " is a film of Triad", std::string("triad resolve"), "triad render --resume " + film})
        EXPECT_NE(outcome.output.find(words), std::string::npos) << outcome.output;
}

TEST(GltfFault, many_instances_are_no_bomb_but_a_list_that_many_nodes_share_is) {
    constexpr unsigned n = 150000;
    GltfBuilder plain, listed;
    nlohmann::json nodes = nlohmann::json::array(), roots = nlohmann::json::array();
    for (unsigned i = 0; i < 3 * n; ++i) nodes.push_back({{"mesh", 0}}), roots.push_back(i);
    plain.triangle().document["nodes"] = nodes;
    plain.document["scenes"][0]["nodes"] = roots;
    EXPECT_EQ(plain.load().instances.size(), 3 * n);

    const auto places = listed.triangle().accessor(std::vector<float>(3 * n, 1.0f), "VEC3");
    const nlohmann::json node = {
        {"mesh", 0},
        {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}};
    listed.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    listed.document["nodes"] = nlohmann::json::array({node});
    EXPECT_EQ(listed.load().instances.size(), n);
    listed.document["nodes"] = nlohmann::json(1000, node);
    listed.document["scenes"][0]["nodes"] = nlohmann::json(roots.begin(), roots.begin() + 1000);
    EXPECT_NE(listed.refusal().find("a file of this size can justify"), std::string::npos);
}

TEST(GltfFault, a_texture_for_basisu_alone_is_left_out_and_one_with_a_fallback_is_used) {
    GltfBuilder b;
    with_image(b, png(2, 2)).document["extensionsUsed"] = {"KHR_texture_basisu"};
    b.document["images"].push_back({{"uri", "data:image/ktx2;base64,q0tUWCAyMLsNChoK"}});
    b.document["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 1}}}};
    EXPECT_TRUE(b.load().materials[0].base_colour_texture.has_value());
    EXPECT_EQ(b.report.warnings.size(), 1u);
    b.document["textures"][0].erase("source");
    EXPECT_FALSE(b.load().materials[0].base_colour_texture.has_value());
    EXPECT_TRUE(b.warned("texture 0"));
}

TEST(GltfFault, a_field_of_view_just_below_180_degrees_is_valid) {
    GltfBuilder b;
    b.triangle().document["nodes"].push_back({{"camera", 0}});
    b.document["scenes"][0]["nodes"] = {0, 1};
    b.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 3.14159}, {"znear", 0.1}}}}};
    EXPECT_EQ(b.load().cameras.size(), 1u);
    b.document["cameras"][0]["perspective"]["yfov"] = 3.1416;
    EXPECT_NE(b.refusal().find("yfov"), std::string::npos);
}

TEST(GltfFault, larger_images_become_means_in_linear_light) {
    EncodedPicture picture{4, 2, 3, 8, {}, {}};  // black and white columns
    for (unsigned i = 0; i < 8; ++i) picture.bytes.insert(picture.bytes.end(), 3, i % 2 ? 255 : 0);
    const auto file = encode_picture(".png", picture);
    GltfBuilder colour, data;
    const Image light = with_image(colour, file).load({.max_texture = 2}).images[0];
    EXPECT_EQ(light.width, 2u);
    EXPECT_EQ(light.height, 1u);
    EXPECT_EQ(light.texels, (std::vector<std::uint8_t>{188, 188, 188, 255, 188, 188, 188, 255}));
    EXPECT_EQ(colour.report.max_texture, 2u);
    const Image plain = with_image(data, file, "metallicRoughnessTexture").load({.max_texture = 2}).images[0];
    EXPECT_EQ(plain.texels, (std::vector<std::uint8_t>{128, 128, 128, 255, 128, 128, 128, 255}));
    EXPECT_EQ(data.load({.max_texture = 4}).images[0].width, 4u);
    EXPECT_EQ(data.report.max_texture, 0u);
}

TEST(GltfFault, images_of_odd_sizes_keep_their_mean) {
    GltfBuilder b;
    const Image image = with_image(b, png(301, 97, 100)).load({.max_texture = 64}).images[0];
    EXPECT_EQ(image.width, 64u);
    EXPECT_EQ(image.height, 21u);
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        ASSERT_EQ(image.texels[i], i % 4 == 3 ? 255 : 100) << i;
}

TEST(GltfFault, images_larger_than_the_memory_are_refused_or_reduced_before_they_are_decoded) {
    GltfBuilder b;
    with_image(b, png(2000, 2000));
    for (const char* list : {"images", "textures"}) b.document[list].push_back(b.document[list][0]);
    b.document["textures"][1]["source"] = 1;
    b.document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
    set_memory_limit(memory_in_use() + (20u << 20));
    EXPECT_NE(b.refusal(Exit::memory).find("Decoding the 2 images of the scene needs"), std::string::npos);
    set_memory_limit(memory_in_use() + (90u << 20));
    EXPECT_EQ(b.load({.max_texture = std::nullopt}).images[0].width, 1024u);
    set_memory_limit(0);
    ASSERT_EQ(b.report.warnings.size(), 1u);
    EXPECT_NE(b.report.warnings[0].find("1024 texels"), std::string::npos) << b.report.warnings[0];
    EXPECT_EQ(b.report.max_texture, 1024u);
    EXPECT_TRUE(b.report.faults.empty());
    EXPECT_EQ(b.load({.max_texture = std::nullopt}).images[1].width, 2000u);
}
