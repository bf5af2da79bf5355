// --frames: each frame is the picture of its moment, in files of its own, and what stops goes on.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/io.h"
#include "program.h"
#include "running.h"
#include "unit/gltf_builder.h"

namespace fs = std::filesystem;

namespace {

/// A glowing triangle that moves to the right for two seconds.
class Frames : public testing::Test {
  protected:
    void SetUp() override {
        GltfBuilder& b = builder_;
        b.triangle();
        b.document["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
        b.primitive()["material"] = 0;
        const auto times = b.accessor(std::vector<float>{0, 2}, "SCALAR"),
                   places = b.accessor(std::vector<float>{0, 0, 0, 4, 0, 0}, "VEC3");
        b.document["animations"] = {
            {{"samplers", {{{"input", times}, {"output", places}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
        b.load();
    }

    std::string folder(const std::string& name) const { return (builder_.folder / name).string(); }
    /// Options of every render; the view does not follow the triangle.
    std::string render(const std::string& options) const {
        return "render " + folder("scene.gltf") +
               " --look-at 2,0.5,6,2,0.5,0 --integrator path --size 32x16 --threads 1 " + options;
    }
    Outcome run(const std::string& options, int exit = 0) const {
        Outcome outcome = run_triad(render(options));
        EXPECT_EQ(outcome.exit, exit) << outcome.output;
        return outcome;
    }
    std::vector<float> red(const std::string& name) const {
        return triad::read_picture(folder(name)).find("R")->values;
    }

    GltfBuilder builder_;
};

}  // namespace

TEST_F(Frames, are_the_pictures_of_their_moments_in_numbered_files) {
    run("--spp 4 --frames 1:3 --fps 2 -o " + folder("a.exr") + " --json " + folder("a.json"));
    EXPECT_FALSE(fs::exists(folder("a.0000.exr")));
    EXPECT_FALSE(fs::exists(folder("a.0003.exr")));
    EXPECT_TRUE(fs::exists(folder("a.0001.json")));
    run("--spp 4 --pose-time 1 -o " + folder("one.exr"));
    EXPECT_EQ(red("a.0002.exr"), red("one.exr"));
    EXPECT_NE(red("a.0001.exr"), red("one.exr"));
}

TEST_F(Frames, films_that_are_there_are_refused_or_gone_on_with) {
    const std::string sequence = "--spp 4 --frames 0:3 --fps 2 --film " + folder("a.film");
    run(sequence);
    const std::string whole = bytes_of(folder("a.0002.film"));
    EXPECT_NE(run(sequence, 1).output.find("a.0000.film is there already"), std::string::npos);
    fs::remove(folder("a.0002.film"));
    run("--spp 4 --frames 0:3 --fps 2 --resume " + folder("a.film"));
    EXPECT_TRUE(bytes_of(folder("a.0002.film")) == whole);
}

TEST_F(Frames, an_interrupted_sequence_names_the_command_that_goes_on) {
    for (const bool film : {false, true}) {
        const std::string kept = film ? " --film " + folder("b.film") : "";
        Running running(
            render("--spp 1000000 --frames 5:7 --fps 4 --progress json -o " + folder("b.exr") + kept));
        ASSERT_TRUE(running.says("\"progress\"")) << running.said();
        running.interrupt();
        EXPECT_TRUE(running.says("To go on: triad render " + folder("scene.gltf"))) << running.said();
        EXPECT_EQ(running.wait(), 75);
        EXPECT_NE(running.said().find("--frames=5:7"), std::string::npos) << running.said();
        EXPECT_EQ(running.said().find("--resume=" + folder("b.film")) != std::string::npos, film);
    }
    // A film of a frame is one of a picture, and goes on by itself, too.
    const Outcome info = run_triad("info " + folder("b.0005.film"));
    EXPECT_NE(info.output.find("--pose-time=1.25"), std::string::npos) << info.output;
}

TEST_F(Frames, go_with_no_standard_output_and_no_single_moment) {
    EXPECT_NE(run("--frames 0:2 -o -", 1).output.find("numbers its files"), std::string::npos);
    EXPECT_NE(run("--frames 0:2 --pose-time 1", 1).output.find("--pose-time"), std::string::npos);
    EXPECT_NE(run("--frames 2:2", 1).output.find("--frames 2:2"), std::string::npos);
}
