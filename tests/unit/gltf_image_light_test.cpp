// EXT_lights_image_based: what is seen in each direction is what the faces show, decoded, strengthened and
// turned; and what is wrong with such a light is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/colour.h"
#include "gltf_builder.h"
#include "io/gltf_contents.h"
#include "scene/environment_maps.h"

namespace triad {
namespace {

using nlohmann::json;

const dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// The texel that a direction falls on.
dvec3 seen(const EnvironmentMap& map, const dvec3& direction) {
    const dvec3 d = glm::normalize(direction);
    const double u = 0.5 + std::atan2(d.z, d.x) / (2 * pi), v = std::acos(d.y) / pi;
    const auto at = [](double t, unsigned n) { return std::min(std::size_t(t * n), std::size_t(n - 1)); };
    const float* t = map.rgb.data() + 3 * (at(v, map.height) * map.width + at(u, map.width));
    return {t[0], t[1], t[2]};
}

void expect_colour(const dvec3& value, const dvec3& expected, const std::string& where) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], 1e-5 * (1 + expected[c])) << where;
}

/// Six faces of RGB or RGBA texels of 8 bits.
struct Faces {
    unsigned width = 4, height = 4, channels = 3;
    std::string type = ".png";
    std::vector<std::uint8_t> bytes[6];

    /// Each of one colour.
    explicit Faces(const std::vector<std::vector<std::uint8_t>>& colours) {
        channels = unsigned(colours[0].size());
        for (int i = 0; i < 6; ++i)
            for (unsigned k = 0; k < width * height; ++k)
                bytes[i].insert(bytes[i].end(), colours[std::size_t(i)].begin(),
                                colours[std::size_t(i)].end());
    }
};

const std::vector<std::vector<std::uint8_t>> six_colours{{200, 0, 0}, {0, 180, 0},   {0, 0, 255},
                                                         {90, 9, 0},  {0, 120, 130}, {77, 66, 55}};

dvec3 decoded(const std::vector<std::uint8_t>& c) {
    return {srgb_decode(c[0] / 255.0), srgb_decode(c[1] / 255.0), srgb_decode(c[2] / 255.0)};
}

/// The triangle in the light of these faces.
GltfBuilder& lit_by(GltfBuilder& b, const Faces& faces) {
    b.triangle();
    json level = json::array();
    for (const auto& bytes : faces.bytes) {
        const auto file =
            encode_picture(faces.type, {faces.width, faces.height, faces.channels, 8, bytes, {}});
        b.document["images"].push_back({{"bufferView", b.view(file)}});
        level.push_back(b.document["images"].size() - 1);
    }
    b.document["extensionsUsed"] = {"EXT_lights_image_based"};
    b.document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    b.document["extensions"]["EXT_lights_image_based"]["lights"] = {
        {{"name", "hall"},
         {"specularImageSize", faces.width},
         {"specularImages", json::array({level})},
         {"irradianceCoefficients", json::array()}}};
    for (int i = 0; i < 9; ++i)
        b.document["extensions"]["EXT_lights_image_based"]["lights"][0]["irradianceCoefficients"].push_back(
            {1, 1, 1});
    return b;
}

json& light(GltfBuilder& b) { return b.document["extensions"]["EXT_lights_image_based"]["lights"][0]; }

TEST(GltfImageLight, each_direction_shows_its_face) {
    GltfBuilder b;
    const Scene scene = lit_by(b, Faces(six_colours)).load();
    ASSERT_TRUE(scene.environment);
    EXPECT_TRUE(b.report.warnings.empty()) << b.report.warnings[0];
    for (std::size_t i = 0; i < 6; ++i)
        for (const dvec3& aside : {dvec3(0.0), dvec3(0.5, 0.3, -0.4), dvec3(-0.4, -0.5, 0.5)}) {
            const dvec3 direction = axes[i] + aside * (1.0 - glm::abs(axes[i]));
            expect_colour(seen(*scene.environment, direction), decoded(six_colours[i]), std::to_string(i));
        }
}

TEST(GltfImageLight, intensity_and_rotation_apply) {
    const double angles[] = {pi / 2, -pi / 2, 0.3};
    const dvec3 around[] = {{0, 1, 0}, {1, 0, 0}, glm::normalize(dvec3(1, 2, 3))};
    for (int k = 0; k < 3; ++k) {
        GltfBuilder b;
        lit_by(b, Faces(six_colours));
        const dquat q = glm::angleAxis(angles[k], around[k]);
        light(b)["rotation"] = {q.x, q.y, q.z, q.w};
        light(b)["intensity"] = 2.5;
        const Scene scene = b.load();
        for (std::size_t i = 0; i < 6; ++i)
            expect_colour(seen(*scene.environment, q * axes[i]), 2.5 * decoded(six_colours[i]),
                          std::to_string(k) + std::to_string(i));
    }
    // By name: a quarter turn about y takes what is towards +z to +x.
    GltfBuilder b;
    lit_by(b, Faces(six_colours));
    light(b)["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
    expect_colour(seen(*b.load().environment, {1, 0, 0}), decoded(six_colours[4]), "+z at +x");
}

TEST(GltfImageLight, faces_are_the_standard_ones_flipped_about_their_vertical_axis) {
    // Coordinates on the faces of OpenGL 4.6, table 8.19.
    const dvec3 s[6] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}},
                t[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    Faces faces(six_colours);
    for (unsigned i = 0; i < 6; ++i)
        for (unsigned k = 0; k < 16; ++k) {
            faces.bytes[i][3 * k] = std::uint8_t(100 + 25 * i);
            faces.bytes[i][3 * k + 1] = std::uint8_t(100 + 40 * (k % 4));
            faces.bytes[i][3 * k + 2] = std::uint8_t(100 + 40 * (k / 4));
        }
    GltfBuilder b;
    const Scene scene = lit_by(b, faces).load();
    for (unsigned i = 0; i < 6; ++i)
        for (unsigned k = 0; k < 16; ++k) {
            const double flipped = 1.0 - (2.0 * (k % 4) + 1.0) / 4.0,
                         down = (2.0 * (k / 4) + 1.0) / 4.0 - 1.0;
            const dvec3 value = seen(*scene.environment, axes[i] + flipped * s[i] + down * t[i]);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(255 * srgb_encode(value[c]), faces.bytes[i][3 * k + unsigned(c)], 18)
                    << "face " << i << ", texel " << k;
        }
}

TEST(GltfImageLight, alpha_of_a_png_divides) {
    GltfBuilder b;
    const Scene scene =
        lit_by(b, Faces(std::vector<std::vector<std::uint8_t>>(6, {200, 100, 50, 51}))).load();
    expect_colour(seen(*scene.environment, {1, 1, 1}), 5.0 * decoded({200, 100, 50}), "RGBD");
}

TEST(GltfImageLight, jpeg_faces_are_decoded_as_other_colours_are) {
    Faces faces(std::vector<std::vector<std::uint8_t>>(6, {128, 128, 128}));
    faces.type = ".jpg";
    GltfBuilder b;
    const Scene scene = lit_by(b, faces).load();
    for (const float x : scene.environment->rgb) EXPECT_NEAR(x, srgb_decode(128 / 255.0), 0.01);
}

TEST(GltfImageLight, equal_faces_are_an_even_sky) {
    GltfBuilder b;
    lit_by(b, Faces(std::vector<std::vector<std::uint8_t>>(6, {255, 255, 255})));
    light(b)["intensity"] = 3;
    const Scene scene = b.load();
    for (const float x : scene.environment->rgb) EXPECT_NEAR(x, 3.0f, 1e-6);
}

TEST(GltfImageLight, without_images_the_irradiance_is_met) {
    GltfBuilder b;
    lit_by(b, Faces(six_colours));
    light(b).erase("specularImages");
    light(b).erase("specularImageSize");
    json& c = light(b)["irradianceCoefficients"];
    c = {{9, 9, 9},  {1, 0, 0},  {0, 1, 0},  {0, 0, 1}, {.3, 0, 0},
         {0, .3, 0}, {0, 0, .3}, {.2, 0, 0}, {0, .2, 0}};
    const EnvironmentMap map = *b.load().environment;
    const auto irradiance = [&](const dvec3& n) {
        dvec3 sum(0.0);
        for (unsigned y = 0; y < map.height; ++y)
            for (unsigned x = 0; x < map.width; ++x) {
                const double theta = pi * (y + 0.5) / map.height,
                             phi = 2 * pi * ((x + 0.5) / map.width - 0.5);
                const dvec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi));
                const float* t = map.rgb.data() + 3 * (y * map.width + x);
                sum += dvec3(t[0], t[1], t[2]) * std::max(glm::dot(n, d), 0.0) * std::sin(theta) *
                       (2 * pi / map.width) * (pi / map.height);
            }
        return sum;
    };
    for (const dvec3& raw :
         {dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, 1), dvec3(1, 1, -1), dvec3(-3, 1, 2)}) {
        const dvec3 n = glm::normalize(raw);
        const double a = 9 * 0.2820948;
        const dvec3 expected(
            a + 0.4886025 * n.y + 0.3 * 1.0925484 * n.x * n.y + 0.2 * 1.0925484 * n.x * n.z,
            a + 0.4886025 * n.z + 0.3 * 1.0925484 * n.y * n.z + 0.2 * 0.5462742 * (n.x * n.x - n.y * n.y),
            a + 0.4886025 * n.x + 0.3 * 0.3153916 * (3 * n.z * n.z - 1));
        const dvec3 got = irradiance(n);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], expected[k], 0.005 * expected[k]);
    }
}

TEST(GltfImageLight, what_is_wrong_is_said) {
    const auto refusal = [](const std::function<void(GltfBuilder&)>& spoil) {
        GltfBuilder b;
        lit_by(b, Faces(six_colours));
        spoil(b);
        return b.refusal();
    };
    const auto expect_refusal = [&](const std::string& part, const std::function<void(GltfBuilder&)>& spoil) {
        const std::string sentence = refusal(spoil);
        EXPECT_NE(sentence.find(part), std::string::npos) << part << "\n" << sentence;
    };
    const std::string at = "extensions.EXT_lights_image_based.lights[0] 'hall'.";
    expect_refusal(
        "light is 1, but there are 1 extensions.EXT_lights_image_based.lights",
        [](GltfBuilder& b) { b.document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1; });
    expect_refusal(at + "specularImages[0] has 5 elements, where 6 must be",
                   [](GltfBuilder& b) { light(b)["specularImages"][0].erase(0); });
    expect_refusal(at + "specularImages is empty",
                   [](GltfBuilder& b) { light(b)["specularImages"] = json::array(); });
    expect_refusal(at + "specularImages[0][3] is 6, but there are 6 images",
                   [](GltfBuilder& b) { light(b)["specularImages"][0][3] = 6; });
    expect_refusal(at + "specularImages[0][3] is not an integer",
                   [](GltfBuilder& b) { light(b)["specularImages"][0][3] = nullptr; });
    expect_refusal(at + "irradianceCoefficients has 10 elements, where 9 must be", [](GltfBuilder& b) {
        light(b)["irradianceCoefficients"].push_back({1, 2, 3});
    });
    expect_refusal(at + "irradianceCoefficients[2] is not an array of 3 numbers", [](GltfBuilder& b) {
        light(b)["irradianceCoefficients"][2] = {1, 2};
    });
    expect_refusal(at + "intensity is -1", [](GltfBuilder& b) { light(b)["intensity"] = -1; });
    expect_refusal("image-based light 0 'hall' has a rotation that is no unit quaternion",
                   [](GltfBuilder& b) {
                       light(b)["rotation"] = {0, 0, 0, 0};
                   });
    expect_refusal("image-based light 0 'hall' has neither", [](GltfBuilder& b) {
        light(b).erase("specularImages");
        light(b).erase("irradianceCoefficients");
    });
    expect_refusal("gone.png", [](GltfBuilder& b) { b.document["images"][2] = {{"uri", "gone.png"}}; });
    expect_refusal("Image image 5", [](GltfBuilder& b) {
        b.document["images"][5] = {{"bufferView", b.view(std::vector<std::uint8_t>(100, 7))}};
    });
    expect_refusal("image-based light 0 'hall': image 1 has 2 x 2 texels, but face 0 has 4 x 4",
                   [](GltfBuilder& b) {
                       const std::vector<std::uint8_t> grey(12, 90);
                       b.document["images"][1] = {
                           {"bufferView", b.view(encode_picture(".png", {2, 2, 3, 8, grey, {}}))}};
                   });
    expect_refusal("image 0 has 2 x 1 texels, but faces of a cube are square", [](GltfBuilder& b) {
        const std::vector<std::uint8_t> grey(6, 90);
        b.document["images"][0] = {{"bufferView", b.view(encode_picture(".png", {2, 1, 3, 8, grey, {}}))}};
    });
}

TEST(GltfImageLight, another_size_than_was_said_is_told_and_damage_is_a_fault) {
    GltfBuilder b;
    lit_by(b, Faces(six_colours));
    light(b)["specularImageSize"] = 256;
    b.load();
    EXPECT_TRUE(b.warned("256 texels along an edge, but they have 4"));
    EXPECT_TRUE(b.report.faults.empty());

    Faces faces(six_colours);
    faces.type = ".jpg";
    GltfBuilder damaged;
    lit_by(damaged, faces);
    json& view = damaged.document["bufferViews"].back();
    view["byteLength"] = view["byteLength"].get<std::size_t>() - 2;  // the end marker
    damaged.load();
    ASSERT_EQ(damaged.report.faults.size(), 1u);
    EXPECT_NE(damaged.report.faults[0].find("image 5"), std::string::npos) << damaged.report.faults[0];
}

TEST(GltfImageLight, is_left_where_another_environment_lights_or_the_scene_names_none) {
    GltfBuilder b;
    lit_by(b, Faces(six_colours));
    EXPECT_FALSE(b.load({.image_light = false}).environment);
    b.document["scenes"][0].erase("extensions");
    EXPECT_FALSE(b.load().environment);
}

}  // namespace
}  // namespace triad
