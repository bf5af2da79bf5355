// Several scenes in one command: each is the picture that it makes alone, whatever becomes of the others.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/io.h"
#include "program.h"
#include "running.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;

namespace {

class Scenes : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directory(folder_ / "out");
        std::ofstream(path("bad.gltf")) << "{";
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    Outcome render(const std::string& arguments, int exit) const {
        Outcome outcome = run_triad("render --size 32x18 --spp 2 " + arguments);
        EXPECT_EQ(outcome.exit, exit) << outcome.output;
        return outcome;
    }
    std::vector<float> red(const std::string& name) const {
        return triad::read_picture(path(name)).find("R")->values;
    }

    triad::TemporaryFolder folder_;
    const std::string knot = TRIAD_SCENES "/suite/knot.glb", metals = TRIAD_SCENES "/suite/metals.glb",
                      cornell = TRIAD_SCENES "/cornell/cornell.gltf";
};

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++n;
    return n;
}

}  // namespace

TEST_F(Scenes, are_the_pictures_that_each_makes_alone_on_a_device_that_stays_open) {
    const Outcome outcome = render(knot + " " + path("bad.gltf") + " " + cornell + " -v -o " +
                                       path("out/%s.exr") + " --json " + path("out/%s.json"),
                                   2);
    EXPECT_NE(outcome.output.find("triad: " + path("bad.gltf") + ": "), std::string::npos) << outcome.output;
    EXPECT_EQ(count(outcome.output, "\nDevice: "), 1u) << outcome.output;
    EXPECT_FALSE(fs::exists(path("out/bad.json")));
    for (const auto& [name, scene] : {std::pair{"knot", knot}, {"cornell", cornell}}) {
        render(scene + " -o " + path("alone.exr"), 0);
        EXPECT_EQ(red("out/" + std::string(name) + ".exr"), red("alone.exr")) << name;
        EXPECT_NE(bytes_of(path("out/" + std::string(name) + ".json")).find("\"triad.render/1\""),
                  std::string::npos);
    }
}

TEST_F(Scenes, by_which_a_device_is_checked_and_tuned_are_not_told_of) {
    const Outcome outcome = run_triad("render -v --size 32x18 --spp 1 " + knot + " -o " + path("out/a.png"),
                                      "XDG_CACHE_HOME=" + path("cache"));
    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("First use of "), std::string::npos) << outcome.output;
    EXPECT_EQ(count(outcome.output, "\npacked "), 1u) << outcome.output;
}

TEST_F(Scenes, need_names_that_tell_them_apart) {
    const auto refused = [&](const std::string& arguments, const std::string& sentence) {
        const Outcome outcome = render(arguments, 1);
        EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
    };
    refused(knot + " " + metals + " -o " + path("one.png"), "one.png: of several scenes");
    refused(knot + " " + metals + " -o " + path("%s.png") + " --json -", "-: of several scenes");
    refused(knot + " " + metals + " --film " + path("one.film"), "one.film: of several scenes");
    refused(knot + " " + knot + " -o " + path("%s.png"), "are both called knot");
    refused(knot + " " + metals + " --frames 0:2 -o " + path("%s.png"), "--frames");
    refused(knot + " " + metals + " --error 0.1 --samples 0:2 -o " + path("%s.png"), "--samples");
    EXPECT_TRUE(fs::is_empty(folder_ / "out"));
    // The name of one scene may be asked for as well.
    render(knot + " -o " + path("out/%s.a.png"), 0);
    EXPECT_TRUE(fs::exists(path("out/knot.a.png")));
}

TEST_F(Scenes, that_are_interrupted_name_the_command_for_those_that_are_left) {
    const std::string options = " -o " + path("out/%s.png") + " --film " + path("out/%s.film");
    // The first is done; the second would take hours.
    render(knot + " -o " + path("out/%s.png") + " --film " + path("out/%s.film"), 0);
    Running running("render --size 32x18 --spp 1000000 --progress json " + metals + " " + cornell + options);
    ASSERT_TRUE(running.says("\"progress\"")) << running.said();
    running.interrupt();
    EXPECT_TRUE(running.says("To go on: triad render " + metals + " " + cornell)) << running.said();
    EXPECT_EQ(running.wait(), 75);
    EXPECT_NE(running.said().find("--resume=" + path("out/%s.film")), std::string::npos) << running.said();
    EXPECT_TRUE(fs::exists(path("out/metals.film")));
    EXPECT_FALSE(fs::exists(path("out/cornell.film")));
    // It goes on with the film that is there, and begins the other.
    const Outcome rest =
        run_triad("render " + metals + " " + cornell + " --size 32x18 --time 0.1 --adaptive off -o " +
                  path("out/%s.png") + " --resume " + path("out/%s.film"));
    EXPECT_EQ(rest.exit, 0) << rest.output;
    EXPECT_NE(rest.output.find("Going on from"), std::string::npos) << rest.output;
    EXPECT_TRUE(fs::exists(path("out/cornell.film")));
}
