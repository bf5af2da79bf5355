// Levels of textures: which images have them, and that every level is a mean of the image, in linear light.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "base/colour.h"
#include "pack/pack.h"
#include "scene/shapes.h"

namespace triad {
namespace {

Image noise(unsigned width, unsigned height, unsigned bits = 8) {
    Image image{"noise", width, height, bits,
                std::vector<std::uint8_t>(std::size_t(width) * height * bits / 2)};
    std::mt19937 random(width + height);
    for (std::uint8_t& byte : image.texels) byte = std::uint8_t(random());
    return image;
}

Scene textured(Image image) {
    Scene scene;
    scene.images.push_back(std::move(image));
    scene.textures.push_back({});
    Material m;
    m.base_colour_texture = TextureUse{};
    scene.materials.push_back(m);
    scene.meshes.push_back({"mesh", {shapes::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}});
    scene.instances.push_back({"node", 0, dmat4(1.0)});
    return scene;
}

PackedSurfaces packed(const Scene& scene, const RenderSettings& settings = {}) {
    PackedSurfaces surfaces;
    pack_materials(scene, settings, surfaces);
    return surfaces;
}

/// Of the material's base colour: the image, then its levels.
std::span<const dev::Texture> pyramid_of(const PackedSurfaces& s, std::size_t material = 0) {
    const std::size_t first = s.texture_uses[s.materials[material].base_colour_use].texture;
    return std::span(s.textures).subspan(first, s.textures[first].levels + 1);
}

/// Means of R, G, B (linear) and alpha over all texels of a texture.
std::array<double, 4> mean_of(const PackedSurfaces& s, const dev::Texture& t) {
    std::array<double, 4> sum{};
    const std::size_t texels = std::size_t(t.width) * t.height;
    for (std::size_t i = 0; i < texels; ++i)
        for (unsigned c = 0; c < 4; ++c) {
            if (t.format == TEXTURE_RGBA16) {
                const std::uint32_t word = s.texels[t.first_texel + 2 * i + c / 2];
                sum[c] += (c % 2 ? word >> 16 : word & 0xffff) / 65535.0;
            } else {
                const double value = (s.texels[t.first_texel + i] >> (8 * c) & 0xff) / 255.0;
                sum[c] += c < 3 ? srgb_decode(value) : value;
            }
        }
    for (double& x : sum) x /= double(texels);
    return sum;
}

TEST(TextureLevels, are_half_as_long_each_down_to_one_texel) {
    const auto sizes = [](unsigned width, unsigned height) {
        std::vector<std::pair<unsigned, unsigned>> all;
        const PackedSurfaces s = packed(textured(noise(width, height)));
        for (const dev::Texture& t : pyramid_of(s)) all.emplace_back(t.width, t.height);
        return all;
    };
    using Sizes = std::vector<std::pair<unsigned, unsigned>>;
    EXPECT_EQ(sizes(256, 128),
              (Sizes{{256, 128}, {128, 64}, {64, 32}, {32, 16}, {16, 8}, {8, 4}, {4, 2}, {2, 1}, {1, 1}}));
    EXPECT_EQ(sizes(301, 173).back(), std::pair(1u, 1u));
    EXPECT_EQ(sizes(301, 173)[1], std::pair(150u, 86u));
    for (const auto& [width, height] : sizes(1, 20000)) EXPECT_EQ(width, 1u) << height;
    EXPECT_EQ(sizes(1, 20000).size(), 15u);
}

TEST(TextureLevels, have_the_mean_of_the_image_in_linear_light) {
    for (const auto& [width, height] :
         {std::pair(256u, 256u), std::pair(301u, 173u), std::pair(1u, 20000u), std::pair(20011u, 1u)})
        for (const unsigned bits : {8u, 16u}) {
            const PackedSurfaces s = packed(textured(noise(width, height, bits)));
            const auto whole = mean_of(s, pyramid_of(s).front());
            for (const dev::Texture& t : pyramid_of(s))
                // half a unit of 8 bits, of the coarsest, and of the first level's noise, at the middle of
                // the curve; of 16 bits, at every level
                for (unsigned c = 0; c < 4; ++c)
                    EXPECT_NEAR(mean_of(s, t)[c], whole[c], bits == 8 ? 0.003 : 1e-4)
                        << width << " x " << height << ", " << bits << " bits, level of " << t.width << " x "
                        << t.height << ", channel " << c;
        }
}

TEST(TextureLevels, texels_are_means_of_what_they_cover) {
    Image image = noise(128, 128);
    const std::array<std::uint8_t, 4> corner[2][2] = {{{{255, 0, 10, 255}}, {{0, 0, 10, 1}}},
                                                      {{{0, 0, 10, 255}}, {{255, 0, 10, 255}}}};
    for (unsigned y = 0; y < 2; ++y)
        for (unsigned x = 0; x < 2; ++x) std::memcpy(&image.texels[4 * (128 * y + x)], &corner[y][x], 4);
    const PackedSurfaces s = packed(textured(image));
    const std::uint32_t texel = s.texels[pyramid_of(s)[1].first_texel];
    EXPECT_EQ(texel & 0xff, 188u) << "half of the light of 255";
    EXPECT_EQ(texel >> 8 & 0xff, 0u);
    EXPECT_EQ(texel >> 16 & 0xff, 10u) << "one colour stays itself";
    EXPECT_EQ(texel >> 24, 192u) << "alpha is no light";
}

TEST(TextureLevels, only_opaque_colours_of_large_images_have_them) {
    const auto levels = [](const Scene& scene, const RenderSettings& settings = {}) {
        const PackedSurfaces s = packed(scene, settings);
        EXPECT_EQ(has_levels(s), s.textures.size() > 1);
        return s.textures.front().levels;
    };
    EXPECT_EQ(levels(textured(noise(128, 128))), 7u);
    EXPECT_EQ(levels(textured(noise(128, 127))), 0u);
    Scene scene = textured(noise(256, 256));
    RenderSettings off;
    off.texture_levels = false;
    EXPECT_EQ(levels(scene, off), 0u);
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        scene.materials[0].alpha_mode = mode;
        EXPECT_EQ(levels(scene), 0u);
    }
    for (const auto member : {&Material::metallic_roughness_texture, &Material::normal_texture,
                              &Material::specular_texture, &Material::transmission_texture}) {
        Scene values = textured(noise(256, 256));
        std::swap(values.materials[0].base_colour_texture, values.materials[0].*member);
        EXPECT_EQ(levels(values), 0u);
    }
}

TEST(TextureLevels, of_an_image_are_kept_once) {
    Scene scene = textured(noise(256, 256));
    const std::size_t texels = packed(scene).texels.size();
    EXPECT_EQ(texels, 65536u + 16384 + 4096 + 1024 + 256 + 64 + 16 + 4 + 1);
    scene.textures.push_back({.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::mirror, .linear = false});
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].base_colour_texture->texture = 1;
    scene.materials[1].metallic_roughness_texture = TextureUse{};  // the same texels, and no levels
    const PackedSurfaces s = packed(scene);
    EXPECT_EQ(s.texels.size(), texels);
    ASSERT_EQ(pyramid_of(s, 1).size(), 9u);
    for (std::size_t i = 0; i < 9; ++i) {
        const dev::Texture &a = pyramid_of(s)[i], &b = pyramid_of(s, 1)[i];
        EXPECT_EQ(a.first_texel, b.first_texel);
        EXPECT_EQ(a.wrap_u, WRAP_REPEAT);
        EXPECT_EQ(b.wrap_u, WRAP_CLAMP);
        EXPECT_EQ(b.wrap_v, WRAP_MIRROR);
        EXPECT_EQ(b.linear, 0u);
    }
}

TEST(TextureLevels, are_a_feature_of_the_scene_and_named_in_films) {
    Scene scene = textured(noise(256, 256));
    validate(scene);
    RenderSettings settings;
    const PackedScene on = pack(scene, settings);
    EXPECT_TRUE(features_of(on, settings).texture_levels);
    EXPECT_NE(text_of(settings, on).find("\"texture_levels\": 1"), std::string::npos);
    settings.texture_levels = false;
    EXPECT_FALSE(holds_for(on, settings));
    const PackedScene off = pack(scene, settings);
    EXPECT_FALSE(features_of(off, settings).texture_levels);
    EXPECT_EQ(text_of(settings, off), text_of(settings)) << "as films of before, which had none";
}

}  // namespace
}  // namespace triad
