// panel.json: what is read is the panel, and what is wrong is named.
#include "panel/panel_json.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "session/panel_file.h"
#include "temporary_folder.h"

using namespace triad;
using nlohmann::json;

namespace {

json stripe() {
    return json::parse(R"({"name": "mine", "cell": [1, 1], "emitters": [
      {"channel": "R", "primary": [0.68, 0.32], "luminance": 0.23, "centre": [0.2, 0.5], "aperture": {"rectangle": [0.3, 0.9]}},
      {"channel": "G", "primary": [0.27, 0.69], "luminance": 0.69, "centre": [0.5, 0.5], "aperture": {"disc": 0.1}},
      {"channel": "B", "primary": [0.15, 0.06], "luminance": 0.08, "centre": [0.8, 0.5],
       "aperture": {"polygon": [[-0.1, -0.4], [0.1, -0.4], [0, 0.4]]}}]})");
}

Panel read(const json& text) { return panel_of_json(text.dump(), "my.json"); }

/// The sentence that a changed file is refused with, or "".
std::string complaint(auto&& change) {
    json text = stripe();
    change(text);
    try {
        read(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::scene);
        return error.what();
    }
    return "";
}

}  // namespace

TEST(PanelJson, is_read_as_written) {
    json text = stripe();
    text["ppd"] = 52.5;
    const Panel panel = read(text);
    EXPECT_EQ(panel.name, "mine");
    ASSERT_EQ(panel.emitters.size(), 3u);
    EXPECT_EQ(panel.emitters[0].name, "R");
    EXPECT_EQ(panel.emitters[0].aperture.corners.size(), 4u);
    EXPECT_EQ(panel.emitters[1].aperture.radius, 0.1);
    EXPECT_EQ(panel.emitters[2].feed, Feed::blue);
    EXPECT_EQ(panel.ppd, 52.5);
    EXPECT_FALSE(panel.advice.full_pixel);
}

TEST(PanelJson, every_built_in_comes_back) {
    for (const Panel& panel : builtin_panels()) {
        const Panel again = panel_of_json(json_of_panel(panel), panel.name);
        EXPECT_EQ(again.name, panel.name);
        EXPECT_EQ(again.advice.full_pixel, panel.advice.full_pixel);
        EXPECT_EQ(again.advice.shift, panel.advice.shift);
        ASSERT_EQ(again.emitters.size(), panel.emitters.size());
        for (std::size_t i = 0; i < panel.emitters.size(); ++i) {
            EXPECT_EQ(again.emitters[i].centre, panel.emitters[i].centre);
            EXPECT_EQ(again.emitters[i].pixel_x, panel.emitters[i].pixel_x);
            EXPECT_EQ(again.emitters[i].aperture.corners, panel.emitters[i].aperture.corners);
            EXPECT_EQ(again.emitters[i].feed, panel.emitters[i].feed);
        }
    }
}

TEST(PanelJson, flips_then_turns) {
    json text = stripe();
    text["flip"] = "horizontal";
    EXPECT_NEAR(read(text).emitters[0].centre.x, 0.8, 1e-12);
    text["rotation"] = 90;
    EXPECT_NEAR(read(text).emitters[0].centre.y, 0.8, 1e-12);
    text["flip"] = "vertical";
    text["rotation"] = 0;
    EXPECT_NEAR(read(text).emitters[0].centre.x, 0.2, 1e-12);
    EXPECT_NEAR(read(text).emitters[2].aperture.corners[2].y, -0.4, 1e-12);
    text["flip"] = "both";
    EXPECT_NEAR(read(text).emitters[0].centre.x, 0.8, 1e-12);
    EXPECT_EQ(read(text).quarter_turns, 2u);
}

TEST(PanelJson, distance_and_pitch_are_pixels_per_degree) {
    json text = stripe();
    text["distance"] = 600, text["pitch"] = 0.2331;
    EXPECT_NEAR(read(text).ppd.value(), 44.92, 0.01);
}

TEST(PanelJson, what_is_wrong_is_named) {
    const auto says = [](const std::string& sentence, const char* words) {
        EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
        EXPECT_TRUE(sentence.starts_with("my.json")) << sentence;
    };
    says(complaint([](json& j) { j.erase("emitters"); }), "lacks \"emitters\"");
    says(complaint([](json& j) { j["emiters"] = 1; }), "unknown member \"emiters\"");
    says(complaint([](json& j) { j["cell"] = {1.5, 1}; }), "panel.cell must be two whole numbers");
    says(complaint([](json& j) { j["cell"] = {0, 1}; }), "cell is 0 x 1");
    says(complaint([](json& j) { j["cell"] = "1x1"; }), "panel.cell must be a list of 2");
    says(complaint([](json& j) { j["emitters"][1]["channel"] = "X"; }), "panel.emitters[1].channel is \"X\"");
    says(complaint([](json& j) { j["emitters"][1]["centre"][0] = "left"; }),
         "panel.emitters[1].centre[0] is no number");
    says(complaint([](json& j) { j["emitters"][0]["aperture"]["disc"] = 1; }), "must have one of");
    says(complaint([](json& j) { j["emitters"][0]["aperture"] = {{"disc", -1}}; }), "no area");
    says(complaint([](json& j) { j["emitters"][0]["luminance"] = -1; }), "luminance");
    says(complaint([](json& j) { j["emitters"].erase(2); }), "no emitter is fed by B");
    says(complaint([](json& j) { j["rotation"] = 45; }), "panel.rotation must be 0, 90, 180 or 270");
    says(complaint([](json& j) { j["flip"] = "sideways"; }), "none, horizontal, vertical, both");
    says(complaint([](json& j) { j["pitch"] = 1; }), "together");
    says(complaint([](json& j) { j["ppd"] = 0; }), "ppd");
    says(complaint([](json& j) { j["shift"] = {0, 0}; }), "full-pixel");
    says(complaint([](json& j) { j["emitters"][0]["channel"] = "W"; }), "no emitter is fed by R");
    says(complaint([](json& j) { j = json::array(); }), "is no object");
}

TEST(PanelJson, text_that_is_no_json_is_refused_at_any_depth) {
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("\0\xff", 2), std::string(100000, '[')})
        EXPECT_THROW(panel_of_json(text, "x"), Error);
}

TEST(PanelFile, is_read_by_name_or_path_and_slips_get_a_hint) {
    const TemporaryFolder folder;
    const std::string path = (folder / "p.json").string();
    std::ofstream(path) << stripe();
    EXPECT_EQ(panel_named(path).name, "mine");
    EXPECT_EQ(panel_named("bgr").name, "bgr");
    EXPECT_EQ(panel_named("bgr@90").quarter_turns, 1u);
    const auto sentence = [](const std::string& name) -> std::string {
        try {
            panel_named(name);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(sentence("qdoled").find("Did you mean qd-oled?"), std::string::npos) << sentence("qdoled");
    EXPECT_NE(sentence("rgb@45").find("@90"), std::string::npos);
    EXPECT_NE(sentence("absent.json").find("absent.json"), std::string::npos);
    std::ofstream(path) << "{";
    EXPECT_TRUE(sentence(path).starts_with(path + " is not valid JSON: parse error")) << sentence(path);
    std::ofstream(path, std::ios::trunc).flush();
    EXPECT_EQ(sentence(path), path + " is empty.");
}
