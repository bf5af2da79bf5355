// The extensions of materials that are blocks of their own: what a file says of them, and what it must not.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"

namespace triad {
namespace {

using nlohmann::json;

/// The triangle, with a texture and a material that has these extensions.
GltfBuilder& with_extensions(GltfBuilder& b, const json& extensions) {
    b.triangle().texture().primitive()["material"] = 0;
    b.document["materials"] = {{{"extensions", extensions}}};
    return b;
}

/// Every extension with every member that is a number or a colour.
json all_factors() {
    return {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}}},
            {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 1}}, {"sheenRoughnessFactor", 0.75}}},
            {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 0.125}}},
            {"KHR_materials_iridescence",
             {{"iridescenceFactor", 0.5},
              {"iridescenceIor", 1.75},
              {"iridescenceThicknessMinimum", 200},
              {"iridescenceThicknessMaximum", 800}}},
            {"KHR_materials_diffuse_transmission",
             {{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", {1, 0.5, 0.25}}}}};
}

/// Their textures.
const std::vector<std::pair<const char*, const char*>> all_textures{
    {"KHR_materials_clearcoat", "clearcoatTexture"},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture"},
    {"KHR_materials_sheen", "sheenColorTexture"},
    {"KHR_materials_sheen", "sheenRoughnessTexture"},
    {"KHR_materials_anisotropy", "anisotropyTexture"},
    {"KHR_materials_iridescence", "iridescenceTexture"},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture"}};

TEST(GltfMaterialExtensions, members_of_another_type_are_named) {
    const json factors = all_factors();
    for (const auto& [extension, members] : factors.items())
        for (const auto& [member, value] : members.items())
            for (const json& wrong :
                 {json("x"), json(nullptr), json(true), json({1, 2}), json({1, 2, "x"})}) {
                GltfBuilder b;
                json malformed = factors;
                malformed[extension][member] = wrong;
                const std::string sentence = with_extensions(b, malformed).refusal();
                EXPECT_NE(sentence.find(member), std::string::npos) << wrong << ": " << sentence;
            }
    for (const auto& [extension, member] : all_textures)
        for (const json& wrong :
             {json(0), json::object(), json({{"index", 1}}), json({{"index", 0.5}}),
              json({{"index", 0}, {"texCoord", "x"}}), json({{"index", 0}, {"scale", json::array()}}),
              json({{"index", 0}, {"extensions", {{"KHR_texture_transform", 1}}}})}) {
            GltfBuilder b;
            json malformed = factors;
            malformed[extension][member] = wrong;
            const std::string sentence = with_extensions(b, malformed).refusal();
            EXPECT_NE(sentence.find(member), std::string::npos) << wrong << ": " << sentence;
        }
}

TEST(GltfMaterialExtensions, numbers_that_no_thickness_or_index_can_be_are_refused) {
    for (const char* member :
         {"iridescenceIor", "iridescenceThicknessMinimum", "iridescenceThicknessMaximum"}) {
        GltfBuilder b;
        const std::string sentence =
            with_extensions(b, {{"KHR_materials_iridescence", {{"iridescenceFactor", 1}, {member, -1}}}})
                .refusal();
        EXPECT_NE(sentence.find(member), std::string::npos) << sentence;
    }
}

/// What tangents the triangle gets whose TEXCOORD_0 runs along x and TEXCOORD_1 along y.
std::vector<vec4> tangents_with(const json& extensions, bool has_uvs = true) {
    GltfBuilder b;
    with_extensions(b, extensions);
    if (has_uvs) {
        b.primitive()["attributes"]["TEXCOORD_0"] = b.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
        b.primitive()["attributes"]["TEXCOORD_1"] = b.accessor(std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2");
    }
    return b.load().meshes.at(0).primitives.at(0).tangents;
}

TEST(GltfMaterialExtensions, what_needs_tangents_gets_them_along_its_own_uvs) {
    const std::vector<vec4> none, along_x(3, vec4(1, 0, 0, 1)), along_y(3, vec4(0, 1, 0, 1));
    const json first{{"index", 0}}, second{{"index", 0}, {"texCoord", 1}};
    const auto coat = [](const json& map) {
        return json{{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", map}}}};
    };
    const auto brushed = [](const json& map) {
        return json{{"KHR_materials_anisotropy", {{"anisotropyStrength", 1}, {"anisotropyTexture", map}}}};
    };
    const json plain{{"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}}};
    EXPECT_EQ(tangents_with(coat(first)), along_x);
    EXPECT_EQ(tangents_with(coat(second)), along_y);
    EXPECT_EQ(tangents_with(brushed(first)), along_x);
    EXPECT_EQ(tangents_with(brushed(second)), along_y);
    EXPECT_EQ(tangents_with(plain), along_x);
    EXPECT_EQ(tangents_with(plain, false), none);
    EXPECT_EQ(tangents_with(coat(first), false), none);
    EXPECT_EQ(tangents_with(all_factors()), along_x);
    EXPECT_EQ(tangents_with({{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}), none);
}

}  // namespace
}  // namespace triad
