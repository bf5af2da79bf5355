// A scene with EXT_lights_image_based, rendered: under an even light a white surface cannot be told from the
// sky, and --env comes before the scene's own light.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/colour.h"
#include "io/io.h"
#include "program.h"
#include "unit/gltf_builder.h"
#include "unit/temporary_folder.h"

using namespace triad;

namespace {

/// A white triangle, diffuse or a mirror, before six grey faces of twice their radiance.
void write_furnace(GltfBuilder& b, bool mirror) {
    b.triangle().primitive()["material"] = 0;
    b.document["materials"] = {
        {{"pbrMetallicRoughness", {{"metallicFactor", int(mirror)}, {"roughnessFactor", int(!mirror)}}},
         {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}};
    const std::vector<std::uint8_t> grey(8 * 8 * 3, 188);
    b.document["images"] = {{{"bufferView", b.view(encode_picture(".png", {8, 8, 3, 8, grey, {}}))}}};
    b.document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    b.document["extensions"]["EXT_lights_image_based"]["lights"] = {
        {{"intensity", 2},
         {"specularImageSize", 8},
         {"specularImages", nlohmann::json::array({nlohmann::json::array({0, 0, 0, 0, 0, 0})})}}};
    b.load();
}

void expect_even(const std::string& arguments, const TemporaryFolder& folder, double radiance) {
    const std::string picture = (folder / "furnace.exr").string();
    const Outcome outcome = run_triad("render " + arguments + " --size 24x24 --spp 64 -o " + picture);
    ASSERT_EQ(outcome.exit, 0) << outcome.output;
    const Picture p = read_picture(picture);
    // A mirror is exact; a diffuse surface's two ways of sampling leave some noise.
    for (const char* channel : {"R", "G", "B"}) {
        double sum = 0;
        for (const float x : p.find(channel)->values) {
            ASSERT_NEAR(x, radiance, 0.2 * radiance) << channel;
            sum += x;
        }
        EXPECT_NEAR(sum / double(p.find(channel)->values.size()), radiance, 2e-3 * radiance) << channel;
    }
}

}  // namespace

TEST(ImageLightCommand, a_white_surface_vanishes_in_an_even_light_and_env_comes_first) {
    const TemporaryFolder folder;
    Picture sky{4, 2, 0, 0, 0, 0, {}, {}};
    for (const char* channel : {"R", "G", "B"})
        sky.channels.push_back({channel, std::vector<float>(8, 0.5f)});
    write_hdr(folder / "sky.hdr", sky);
    for (const bool mirror : {false, true}) {
        GltfBuilder b;
        write_furnace(b, mirror);
        const std::string scene = (b.folder / "scene.gltf").string();
        expect_even(scene, folder, 2 * srgb_decode(188 / 255.0));
        expect_even(scene + " --env-strength 3", folder, 6 * srgb_decode(188 / 255.0));
        expect_even(scene + " --env " + (folder / "sky.hdr").string(), folder, 0.5);
    }
}
