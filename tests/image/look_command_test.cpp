// What a scene without light gets, through the command line.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "expect_exit.h"
#include "io/io.h"
#include "unit/temporary_folder.h"

using namespace triad;

namespace {

/// A triangle that stands upright; with `lamp`, a point light of that many candela two metres before it.
void write_scene(const std::filesystem::path& path, const std::string& lamp = "") {
    const std::string light =
        lamp.empty()
            ? ""
            : R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":)" +
                  lamp + "}]}}";
    const std::string node =
        lamp.empty() ? "" : R"(,{"translation":[0,0,2],"extensions":{"KHR_lights_punctual":{"light":0}}})";
    std::ofstream(path)
        << R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0)" << (lamp.empty() ? "" : ",1")
        << R"(]}],"nodes":[{"mesh":0})" << node
        << R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAvwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])"
        << light << "}";
}

/// Mean of the green of the lowest rows, where a ground would be.
double green_below(const std::filesystem::path& path) {
    const Picture picture = read_picture(path);
    const std::vector<float>& green = picture.find("G")->values;
    double sum = 0;
    for (std::size_t i = green.size() - 4 * picture.width; i < green.size(); ++i) sum += green[i];
    return sum / (4.0 * picture.width);
}

}  // namespace

TEST(LookCommand, a_model_without_light_stands_in_a_studio_on_a_ground) {
    const TemporaryFolder folder;
    write_scene(folder / "a.gltf");
    const std::string render = "render " + (folder / "a.gltf").string() + " --size 48x32 --spp 64 -o ",
                      ground = (folder / "ground.exr").string(), none = (folder / "none.exr").string();
    expect_exit(0, render + ground, "stands in a soft studio");
    expect_exit(0, render + none + " --ground off");
    EXPECT_NEAR(green_below(ground), 0.5, 0.1) << "half of white paper, less its shadow";
    EXPECT_NEAR(green_below(none), 0.5, 0.1) << "the room has the ground's radiance";
    EXPECT_NE(read_picture(ground).find("G")->values, read_picture(none).find("G")->values);
    expect_exit(0, render + none + " --look white --ground off");
    EXPECT_NEAR(green_below(none), 1.0, 0.01);
    expect_exit(0, render + none + " --look sky --orbit 90,20,1.5");
    expect_exit(1, render + none + " --look night", "studio, sky and white");
    expect_exit(1, render + none + " --ground maybe", "on, off and auto");
    expect_exit(1, render + none + " --orbit 10,90", "89.9");
    expect_exit(1, render + none + " --orbit 10,20 --look-at 0,0,5,0,0,0");
}

TEST(LookCommand, a_weak_lamp_gets_a_sentence_with_the_remedy) {
    const TemporaryFolder folder;
    write_scene(folder / "weak.gltf", "0.01"), write_scene(folder / "strong.gltf", "60");
    const std::string render = "render --size 32x24 --spp 4 -o " + (folder / "a.png").string() + " ";
    expect_exit(0, render + (folder / "weak.gltf").string(), "--look studio or --env FILE");
    expect_exit(0, render + (folder / "weak.gltf").string() + " --look studio");
    expect_exit(0, render + (folder / "weak.gltf").string() + " --max-depth 1 --exposure auto",
                "--look studio or --env FILE");
    const Outcome strong = run_triad(render + (folder / "strong.gltf").string());
    EXPECT_EQ(strong.output.find("nearly black"), std::string::npos) << strong.output;
}
