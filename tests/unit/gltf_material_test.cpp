// Materials, textures and the policy for extensions.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"

namespace triad {
namespace {

Material only_material(GltfBuilder& b) {
    const Scene scene = b.load();
    return scene.materials.at(scene.meshes.at(0).primitives.at(0).material);
}

GltfBuilder& with_material(GltfBuilder& b, const nlohmann::json& material) {
    b.triangle().primitive()["material"] = 0;
    b.document["materials"] = nlohmann::json::array({material});
    return b;
}

TEST(GltfMaterial, defaults_are_those_of_gltf) {
    GltfBuilder b;
    const Material m = only_material(with_material(b, nlohmann::json::object()));
    EXPECT_EQ(m.base_colour, vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.emission, vec3(0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_FALSE(m.double_sided);
}

TEST(GltfMaterial, every_factor_arrives_and_ranges_are_kept) {
    GltfBuilder b;
    const Material m = only_material(with_material(
        b, {{"alphaMode", "MASK"},
            {"alphaCutoff", 0.25},
            {"doubleSided", true},
            {"emissiveFactor", {0.5, 1, 0}},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {0.1, 0.2, 2, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}},
            {"extensions",
             {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
              {"KHR_materials_ior", {{"ior", 0}}},
              {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {2, 1, 0}}}},
              {"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
              {"KHR_materials_volume",
               {{"thicknessFactor", 3}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0.25}}}},
              {"KHR_materials_unlit", nlohmann::json::object()}}}}));
    EXPECT_EQ(m.base_colour, vec4(0.1f, 0.2f, 1, 1)) << "clamped";
    EXPECT_EQ(m.metallic, 0.0f);
    EXPECT_EQ(m.roughness, 0.5f);
    EXPECT_EQ(m.emission, vec3(2, 4, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.25f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.ior, 0.0f) << "the value that means a Fresnel term of one";
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_colour, vec3(2, 1, 0));
    EXPECT_EQ(m.transmission, 0.75f);
    EXPECT_EQ(m.thickness, 3.0f);
    EXPECT_EQ(m.attenuation_distance, 2.0f);
    EXPECT_EQ(m.attenuation_colour, vec3(1, 0.5f, 0.25f));
    EXPECT_TRUE(m.unlit);
}

TEST(GltfMaterial, texture_transform_turns_the_way_its_own_example_does) {
    // KHR_texture_transform's example: offset 0 1, rotation pi / 2, scale .5 .5 shows the lower left quarter,
    // turned.
    GltfBuilder b;
    with_material(
        b, {{"pbrMetallicRoughness",
             {{"baseColorTexture",
               {{"index", 0},
                {"extensions",
                 {{"KHR_texture_transform",
                   {{"offset", {0, 1}}, {"rotation", pi / 2}, {"scale", {0.5, 0.5}}, {"texCoord", 1}}}}}}}}}})
        .texture();
    const TextureUse use = only_material(b).base_colour_texture.value();
    EXPECT_EQ(use.uv_set, 1u);
    const std::array<float, 6> expected{0, 0.5f, 0, -0.5f, 0, 1};
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(use.transform[std::size_t(i)], expected[std::size_t(i)], 1e-6) << i;
}

TEST(GltfMaterial, samplers_give_wrap_and_filter) {
    struct Case {
        nlohmann::json sampler;
        bool linear;
        Wrap u, v;
    };
    for (const Case& c :
         {Case{{{"magFilter", 9728}, {"wrapS", 33071}}, false, Wrap::clamp, Wrap::repeat},
          Case{
              {{"magFilter", 9729}, {"minFilter", 9728}, {"wrapT", 33648}}, true, Wrap::repeat, Wrap::mirror},
          Case{{{"minFilter", 9984}}, false, Wrap::repeat, Wrap::repeat},
          Case{{{"minFilter", 9985}}, true, Wrap::repeat, Wrap::repeat},
          Case{nlohmann::json::object(), true, Wrap::repeat, Wrap::repeat}}) {
        GltfBuilder b;
        with_material(b, {{"normalTexture", {{"index", 0}, {"scale", 2}}}}).texture();
        b.document["textures"][0]["sampler"] = 0;
        b.document["samplers"] = nlohmann::json::array({c.sampler});
        const Scene scene = b.load();
        const Texture& t = scene.textures.at(0);
        EXPECT_EQ(t.linear, c.linear) << c.sampler;
        EXPECT_EQ(t.wrap_u, c.u) << c.sampler;
        EXPECT_EQ(t.wrap_v, c.v) << c.sampler;
        EXPECT_EQ(scene.materials.at(0).normal_scale, 2.0f);
        EXPECT_EQ(scene.images.at(0).texels, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    }
}

TEST(GltfMaterial, what_no_drawn_primitive_uses_is_not_decoded) {
    GltfBuilder b;
    b.triangle().texture();
    b.document["images"].push_back({{"uri", "data:image/webp;base64,UklGRhAAAABXRUJQVlA4IA=="}});
    EXPECT_TRUE(b.load().images.empty());
}

TEST(GltfMaterial, an_image_that_cannot_be_decoded_is_named) {
    GltfBuilder b;
    with_material(b, {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}}).texture();
    b.document["images"][0] = {{"name", "glow"}, {"uri", "data:image/png;base64,iVBORw0KGgo="}};
    EXPECT_NE(b.refusal().find("image 0 'glow'"), std::string::npos) << b.refusal();
}

TEST(GltfMaterial, ktx_is_left_out_unless_there_is_another_image_and_refused_where_it_is_required) {
    GltfBuilder b;
    with_material(b, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}).texture();
    b.document["images"].push_back({{"uri", "data:image/ktx2;base64,q0tUWCAyMLsNChoK"}});
    b.document["textures"][0] = {{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}};
    EXPECT_TRUE(only_material(b).base_colour_texture.has_value());
    EXPECT_FALSE(b.warned("left out (convert"));
    b.document["textures"][0].erase("source");
    EXPECT_FALSE(only_material(b).base_colour_texture.has_value());
    EXPECT_TRUE(b.warned("needs KHR_texture_basisu"));
    b.document["textures"][0] = {{"source", 1}};  // not declared at all
    EXPECT_FALSE(only_material(b).base_colour_texture.has_value());
    EXPECT_TRUE(b.warned("needs KHR_texture_basisu"));
    b.document["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_NE(b.refusal(Exit::unsupported).find("KHR_texture_basisu"), std::string::npos);
}

TEST(GltfMaterial, specular_glossiness_becomes_a_dielectric_of_that_reflectance) {
    GltfBuilder b;
    const nlohmann::json model{{"diffuseFactor", {0.5, 0.25, 1, 0.5}},
                               {"specularFactor", {0.2, 0.3, 0.4}},
                               {"glossinessFactor", 0.75}};
    const Material m =
        only_material(with_material(b, {{"pbrMetallicRoughness", {{"metallicFactor", 1}}},
                                        {"extensions", {{"KHR_materials_pbrSpecularGlossiness", model}}}}));
    EXPECT_EQ(m.base_colour, vec4(0.5f, 0.25f, 1, 0.5f));
    EXPECT_EQ(m.metallic, 0.0f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.ior, 0.0f) << "a Fresnel term of one: the specular colour is the reflectance";
    EXPECT_EQ(m.specular_colour, vec3(0.2f, 0.3f, 0.4f));
}

TEST(GltfMaterial, glossiness_textures_become_roughness_texel_by_texel) {
    GltfBuilder b;
    const nlohmann::json model{{"specularGlossinessTexture", {{"index", 0}}}, {"glossinessFactor", 0.5}};
    with_material(b, {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", model}}}}).texture();
    const Scene scene = b.load();
    const Material& m = scene.materials.at(0);
    const auto texels = [&](const std::optional<TextureUse>& use) {
        return scene.images.at(scene.textures.at(use.value().texture).image).texels;
    };
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(texels(m.specular_colour_texture), (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    EXPECT_EQ(texels(m.metallic_roughness_texture),
              (std::vector<std::uint8_t>{0, 128, 0, 255, 0, 191, 0, 255}));
}

TEST(GltfMaterial, an_unknown_extension_is_refused_when_required_and_reported_when_used) {
    GltfBuilder b;
    b.triangle().document["extensionsUsed"] = {"FAKE_materials_velvet"};
    EXPECT_EQ(b.load().instances.size(), 1u);
    EXPECT_TRUE(b.warned("FAKE_materials_velvet"));
    EXPECT_EQ(b.report.warnings.size(), 1u);
    b.document["extensionsRequired"] = {"FAKE_materials_velvet"};
    EXPECT_NE(b.refusal(Exit::unsupported).find("FAKE_materials_velvet"), std::string::npos);
}

TEST(GltfMaterial, a_third_uv_set_leaves_the_texture_out) {
    GltfBuilder b;
    with_material(b, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 2}}}}}})
        .texture();
    EXPECT_FALSE(only_material(b).base_colour_texture.has_value());
    EXPECT_TRUE(b.warned("TEXCOORD_2"));
}

}  // namespace
}  // namespace triad
