// The extensions of materials that are blocks of their own: what a file says of them, and what the scene has
// of it.
#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gltf_extended_material.h"
#include "pack/features.h"
#include "pack/pack.h"

namespace triad {
namespace {

using nlohmann::json;

/// As loaded from that file.
Material material_with(const json& extensions) {
    GltfBuilder b;
    return with_extensions(b, extensions).load().materials.at(0);
}

TEST(GltfMaterialExtensions, every_factor_arrives) {
    const Material m = material_with(all_factors());
    EXPECT_EQ(m.clearcoat.value().factor, 0.5f);
    EXPECT_EQ(m.clearcoat->roughness, 0.25f);
    EXPECT_EQ(m.clearcoat->normal_scale, 1.0f);
    EXPECT_EQ(m.sheen.value().colour, vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(m.sheen->roughness, 0.75f);
    EXPECT_EQ(m.anisotropy.value().strength, 0.5f);
    EXPECT_EQ(m.anisotropy->rotation, 0.125f);
    EXPECT_EQ(m.iridescence.value().factor, 0.5f);
    EXPECT_EQ(m.iridescence->ior, 1.75f);
    EXPECT_EQ(m.iridescence->thickness_minimum, 200.0f);
    EXPECT_EQ(m.iridescence->thickness_maximum, 800.0f);
    EXPECT_EQ(m.diffuse_transmission.value().factor, 0.5f);
    EXPECT_EQ(m.diffuse_transmission->colour, vec3(1, 0.5f, 0.25f));
    EXPECT_TRUE(texture_uses_of(m).empty());
}

TEST(GltfMaterialExtensions, defaults_are_those_of_their_texts) {
    const Material m = material_with(
        {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}}}}},
         {"KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}}},
         {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}},
         {"KHR_materials_iridescence", {{"iridescenceFactor", 1}}},
         {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 1}}}});
    EXPECT_EQ(m.clearcoat.value().roughness, 0.0f);
    EXPECT_EQ(m.clearcoat->normal_scale, 1.0f);
    EXPECT_EQ(m.sheen.value().roughness, 0.0f);
    EXPECT_EQ(m.anisotropy.value().rotation, 0.0f);
    EXPECT_EQ(m.iridescence.value().ior, 1.3f);
    EXPECT_EQ(m.iridescence->thickness_minimum, 100.0f);
    EXPECT_EQ(m.iridescence->thickness_maximum, 400.0f);
    EXPECT_EQ(m.diffuse_transmission.value().colour, vec3(1));
}

TEST(GltfMaterialExtensions, what_does_nothing_is_not_there) {
    const json texture{{"index", 0}};
    const auto expect_none = [](const json& extensions) {
        GltfBuilder b;
        const Scene scene = with_extensions(b, extensions).load();
        const Material& m = scene.materials.at(0);
        EXPECT_FALSE(m.clearcoat || m.sheen || m.anisotropy || m.iridescence || m.diffuse_transmission)
            << extensions;
        EXPECT_TRUE(scene.images.empty()) << extensions;
    };
    const std::vector<std::pair<const char*, json>> zeros{
        {"KHR_materials_clearcoat", {{"clearcoatFactor", 0}, {"clearcoatTexture", texture}}},
        {"KHR_materials_sheen", {{"sheenColorFactor", {0, -1, 0}}, {"sheenColorTexture", texture}}},
        {"KHR_materials_anisotropy", {{"anisotropyStrength", -1}, {"anisotropyTexture", texture}}},
        {"KHR_materials_iridescence", {{"iridescenceFactor", 0}, {"iridescenceTexture", texture}}},
        {"KHR_materials_diffuse_transmission",
         {{"diffuseTransmissionFactor", 0}, {"diffuseTransmissionTexture", texture}}}};
    for (const auto& [extension, members] : zeros) {
        expect_none({{extension, members}});
        expect_none({{extension, json::object()}});
    }
    json unlit = all_factors();
    unlit["KHR_materials_unlit"] = json::object();
    expect_none(unlit);
}

TEST(GltfMaterialExtensions, ranges_are_kept) {
    GltfBuilder b;
    const Material m =
        with_extensions(
            b, {{"KHR_materials_clearcoat", {{"clearcoatFactor", 2}, {"clearcoatRoughnessFactor", -1}}},
                {"KHR_materials_sheen", {{"sheenColorFactor", {2, -1, 0.5}}, {"sheenRoughnessFactor", 3}}},
                {"KHR_materials_anisotropy", {{"anisotropyStrength", 2}, {"anisotropyRotation", 2 * pi + 1}}},
                {"KHR_materials_iridescence", {{"iridescenceFactor", 2}, {"iridescenceIor", 0.5}}},
                {"KHR_materials_diffuse_transmission",
                 {{"diffuseTransmissionFactor", 2}, {"diffuseTransmissionColorFactor", {2, -1, 0.5}}}}})
            .load()
            .materials.at(0);
    EXPECT_EQ(m.clearcoat.value().factor, 1.0f);
    EXPECT_EQ(m.clearcoat->roughness, 0.0f);
    EXPECT_EQ(m.sheen.value().colour, vec3(1, 0, 0.5f));
    EXPECT_EQ(m.sheen->roughness, 1.0f);
    EXPECT_EQ(m.anisotropy.value().strength, 1.0f);
    EXPECT_NEAR(m.anisotropy->rotation, 1.0f, 1e-6f);
    EXPECT_EQ(m.iridescence.value().factor, 1.0f);
    EXPECT_EQ(m.iridescence->ior, 1.0f);
    EXPECT_TRUE(b.warned("iridescenceIor below 1"));
    EXPECT_EQ(m.diffuse_transmission.value().factor, 1.0f);
    EXPECT_EQ(m.diffuse_transmission->colour, vec3(1, 0, 0.5f));
}

TEST(GltfMaterialExtensions, textures_arrive_each_with_its_own_transform) {
    json extensions = all_factors();
    for (std::size_t i = 0; i < all_textures.size(); ++i)
        extensions[all_textures[i].first][all_textures[i].second] = {
            {"index", 0},
            {"scale", 2},
            {"extensions", {{"KHR_texture_transform", {{"offset", {i + 1, 0}}, {"texCoord", i % 2}}}}}};
    const Material m = material_with(extensions);
    const std::vector<std::optional<TextureUse>> uses{
        m.clearcoat.value().texture,     m.clearcoat->roughness_texture,
        m.clearcoat->normal_texture,     m.sheen.value().colour_texture,
        m.sheen->roughness_texture,      m.anisotropy.value().texture,
        m.iridescence.value().texture,   m.iridescence->thickness_texture,
        m.diffuse_transmission->texture, m.diffuse_transmission->colour_texture};
    ASSERT_EQ(uses.size(), all_textures.size());
    for (std::size_t i = 0; i < uses.size(); ++i) {
        EXPECT_EQ(uses[i].value().transform[2], float(i + 1)) << all_textures[i].second;
        EXPECT_EQ(uses[i]->uv_set, i % 2) << all_textures[i].second;
    }
    EXPECT_EQ(m.clearcoat->normal_scale, 2.0f);
    EXPECT_EQ(texture_uses_of(m).size(), uses.size());
}

TEST(GltfMaterialExtensions, colours_are_reduced_in_linear_light_and_data_as_they_are) {
    // The mean of red and half-transparent green: 188 in linear light, 128 of the bytes.
    for (const auto& [extension, member] : all_textures) {
        GltfBuilder b;
        json extensions = all_factors();
        extensions[extension][member] = {{"index", 0}};
        const Image image = with_extensions(b, extensions).load({.max_texture = 1}).images.at(0);
        ASSERT_EQ(image.texels.size(), 4u);
        const bool is_colour = std::string(member).find("Color") != std::string::npos;
        EXPECT_EQ(image.texels[0], is_colour ? 188 : 128) << member;
    }
}

TEST(GltfMaterialExtensions, points_and_lines_have_what_needs_no_direction_along_the_surface) {
    json extensions = all_factors();
    extensions["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = {{"index", 0}};
    for (const bool has_normals : {true, false}) {
        GltfBuilder b;
        with_extensions(b, extensions).primitive()["mode"] = 0;
        if (has_normals)
            b.primitive()["attributes"]["NORMAL"] =
                b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        const Scene scene = b.load();
        const Material& m = scene.materials.at(scene.meshes.at(0).primitives.at(0).material);
        EXPECT_FALSE(m.anisotropy);
        EXPECT_EQ(m.clearcoat && !m.clearcoat->normal_texture, has_normals);
        EXPECT_EQ(m.sheen && m.iridescence && m.diffuse_transmission, has_normals);
    }
}

TEST(GltfMaterialExtensions, scenes_that_differ_in_one_alone_differ_in_their_hash) {
    const auto hash_with = [](const json& extensions) {
        GltfBuilder b;
        return hash_of(with_extensions(b, extensions).load());
    };
    const std::string without = hash_with(json::object());
    std::set<std::string> hashes{without};
    const json factors = all_factors();
    for (const auto& [extension, members] : factors.items()) {
        EXPECT_TRUE(hashes.insert(hash_with({{extension, members}})).second) << extension;
        EXPECT_EQ(hash_with({{extension, json::object()}}), without) << extension;
        for (const auto& [member, value] : members.items()) {
            json changed = members;
            changed[member] =
                value.is_array() ? json({0.125, 0.125, 0.125}) : json(value.get<double>() + 0.1);
            EXPECT_TRUE(hashes.insert(hash_with({{extension, changed}})).second) << member;
        }
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

TEST(GltfMaterialExtensions, bodies_that_light_gets_into_diffusely_are_solid) {
    struct Case {
        double thickness, transmission, diffuse;
        bool solid, transmits;
    };
    for (const Case& c : {Case{1, 0, 0, false, false}, Case{0, 1, 0, false, true}, Case{1, 1, 0, true, true},
                          Case{0, 0, 1, false, false}, Case{1, 0, 1, true, true}}) {
        GltfBuilder b;
        const Scene scene =
            with_extensions(
                b, {{"KHR_materials_volume", {{"thicknessFactor", c.thickness}}},
                    {"KHR_materials_transmission", {{"transmissionFactor", c.transmission}}},
                    {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", c.diffuse}}}})
                .load();
        PackedSurfaces packed;
        pack_materials(scene, {}, packed);
        EXPECT_EQ((packed.materials.at(0).flags & MATERIAL_SOLID) != 0, c.solid) << c.thickness << c.diffuse;
        EXPECT_EQ(facts_of(scene).transmission, c.transmits) << c.thickness << c.diffuse;
        EXPECT_EQ(facts_of(scene).diffuse_transmission, c.diffuse > 0);
    }
}

}  // namespace
}  // namespace triad
