// Scenes and settings of benches are options of triad render: what is typed there is what counts here.
#include "cli/experiment.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace triad {
namespace {

/// What is said about scene and setting; empty: nothing.
std::string complaint(const std::string& scene, const std::string& setting) {
    try {
        render_options({"--size", "8x8"}, parse_scene(scene), parse_setting(setting));
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::usage);
        return error.what();
    }
    return "";
}

TEST(Experiment, scenes_are_files_or_names_with_options) {
    EXPECT_EQ(parse_scene("models/hall.glb").name, "hall");
    EXPECT_EQ(parse_scene("models/hall.glb").arguments, std::vector<std::string>{"models/hall.glb"});
    const NamedOptions dusk = parse_scene("dusk: 'my hall.glb' --env-strength 2 --env x.hdr");
    EXPECT_EQ(dusk.name, "dusk");
    EXPECT_EQ(dusk.arguments,
              (std::vector<std::string>{"my hall.glb", "--env-strength", "2", "--env", "x.hdr"}));
    EXPECT_EQ(dusk.text(), "'my hall.glb' --env-strength 2 --env x.hdr");
}

TEST(Experiment, words_are_those_of_a_shell) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(words("  --size\t8x8 "), (Words{"--size", "8x8"}));
    EXPECT_EQ(words("--out='a b'.exr \"it's\" [x y]"), (Words{"--out=a b.exr", "it's", "[x", "y]"}));
    EXPECT_EQ(words(" ''"), Words{});
}

TEST(Experiment, settings_may_go_without_a_name) {
    EXPECT_EQ(parse_setting("--roulette 1").name, "--roulette 1");
    EXPECT_EQ(parse_setting("plain:").name, "plain");
    EXPECT_TRUE(parse_setting("plain:").arguments.empty());
    EXPECT_THROW(parse_setting("roulette 1"), Error);
    EXPECT_THROW(parse_setting(" : --roulette 1"), Error);
}

TEST(Experiment, the_setting_overrules_the_scene_and_the_scene_what_is_common) {
    const auto size = [](const char* scene, const char* setting) {
        return render_options({"--size", "8x8"}, parse_scene(scene), parse_setting(setting)).size;
    };
    EXPECT_EQ(size("a.glb", "x:"), uvec2(8, 8));
    EXPECT_EQ(size("a: a.glb --size 9x9", "x:"), uvec2(9, 9));
    EXPECT_EQ(size("a: a.glb --size 9x9", "x: --size 7x7"), uvec2(7, 7));
    const RenderRequest o =
        render_options({}, parse_scene("a.glb"), parse_setting("x: --sampler independent"));
    EXPECT_TRUE(o.independent);
    EXPECT_EQ(o.scene_path, "a.glb");
}

TEST(Experiment, comparisons_are_products) {
    const auto settings = compare(compare({{"", {}}}, "roulette=0.5,1"), "sampler=sobol,independent");
    ASSERT_EQ(settings.size(), 4u);
    EXPECT_EQ(settings[1].name, "roulette 0.5, sampler independent");
    EXPECT_EQ(settings[1].arguments,
              (std::vector<std::string>{"--roulette", "0.5", "--sampler", "independent"}));
    for (const char* bad : {"roulette", "=1", "roulette=", "roulette=1,,2"})
        EXPECT_THROW(compare({{"", {}}}, bad), Error) << bad;
}

TEST(Experiment, slips_are_named_with_scene_and_setting) {
    EXPECT_EQ(complaint("a.glb", "x: --roulette 1"), "");
    EXPECT_NE(complaint("a.glb", "x: --rulette 1").find("Scene a, setting x: "), std::string::npos);
    EXPECT_NE(complaint("a.glb", "x: --size 0x3").find("--size 0x3"), std::string::npos);
    EXPECT_NE(complaint("a.glb", "x: --spp 3").find("--spp is for the bench"), std::string::npos);
    EXPECT_NE(complaint("a.glb", "x: --seed 3").find("--seed is for the bench"), std::string::npos);
    EXPECT_NE(complaint("a.glb", "x: -o y.png").find("--output is for the bench"), std::string::npos);
    EXPECT_NE(complaint("a.glb", "x: b.glb").find("not expected: b.glb"), std::string::npos);
}

}  // namespace
}  // namespace triad
