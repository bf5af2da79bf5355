// triad panel and triad compare --metric perceived, as typed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/io.h"
#include "panel/panel.h"
#include "program.h"
#include "report/panel_report.h"
#include "temporary_folder.h"

using namespace triad;
using nlohmann::json;

namespace {

void expect(const std::string& arguments, int exit, const std::string& sentence) {
    const Outcome outcome = run_triad(arguments);
    EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << arguments << "\n" << outcome.output;
}

json rows(const std::filesystem::path& path) {
    std::ifstream file(path);
    return json::parse(file)["rows"];
}

/// A vertical edge between bins, `samples` a pixel, 24 pixels wide and high.
std::string edge(const TemporaryFolder& folder, const std::string& name, unsigned samples,
                 Metadata metadata = {}) {
    const unsigned n = 24 * samples;
    Picture picture{n, n, 0, 0, 0, 0, {}, std::move(metadata)};
    for (const char* channel : {"R", "G", "B"}) {
        std::vector<float> values;
        for (unsigned i = 0; i < n * n; ++i) values.push_back(i % n * 2 < n ? 0.8f : 0.1f);
        picture.channels.push_back({channel, values});
    }
    const std::string path = (folder / name).string();
    write_exr(path, picture);
    return path;
}

}  // namespace

TEST(PanelCommand, lists_and_prints_rows) {
    const TemporaryFolder folder;
    const std::string file = (folder / "rows.json").string();
    expect("panel --json " + file, 0, "qd-oled");
    const json list = rows(file);
    ASSERT_EQ(list.size(), builtin_panels().size());
    for (const json& row : list) {
        EXPECT_TRUE(row["name"].is_string() && row["emitters"].is_array() && row["cell"].size() == 2);
        EXPECT_TRUE(row["advice"] == "subpixel" || row["advice"] == "full-pixel");
    }
    expect("panel rgb --taps --bins 3x1 --json " + file, 0, "3 x 1 bins");
    double sum = 0;
    const json row = rows(file)[0];
    for (const double w : row["taps"]["outputs"][2]["weights"]) sum += w;
    EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(PanelCommand, writes_a_file_that_it_reads_again) {
    const TemporaryFolder folder;
    const std::string file = (folder / "mine.json").string();
    expect("panel pentile@90 --write " + file, 0, "pentile");
    expect("panel " + file, 0, "cell 2 x 2");
}

TEST(PanelCommand, refuses_with_a_sentence) {
    const TemporaryFolder folder;
    std::ofstream(folder / "bad.json") << R"({"name": "x", "emitters": [{}]})";
    expect("panel qdoled", 1, "Did you mean qd-oled?");
    expect("panel " + (folder / "bad.json").string(), 2, "panel.emitters[0]");
    expect("panel /no/such/panel.json", 2, "/no/such/panel.json");
    expect("panel --taps", 1, "Name the panel");
    expect("panel rgb -o x.bmp", 1, "x.bmp");
    expect("panel rgb --taps --bins 99x1", 1, "1 to 16");
    expect("panel qd-oled --taps --filter platt", 1, "stripes");
    expect("panel rgb -o /tmp/x.png --picture /no/such.png", 2, "/no/such.png");
}

TEST(PanelCommand, drawings_show_every_emitter_where_it_is) {
    for (const Panel& panel : builtin_panels()) {
        constexpr unsigned zoom = 24;
        const RgbImage image = magnified(panel, zoom);
        ASSERT_EQ(image.width, 2 * panel.cell_x * zoom);
        for (const Emitter& e : panel.emitters) {
            const auto x = unsigned(e.centre.x * zoom), y = unsigned(e.centre.y * zoom);
            const float* rgb = image.rgb.data() + (std::size_t(y) * image.width + x) * 3;
            for (unsigned c = 0; c < 3; ++c) {
                const bool own = e.feed == Feed::white || unsigned(e.feed) == c || panel.name == "off";
                EXPECT_EQ(rgb[c] > 0.2f, own) << panel.name << " " << e.name << " " << rgb[c];
            }
        }
    }
}

TEST(PerceivedCommand, finds_the_reference_by_its_size_and_keeps_the_limit) {
    const TemporaryFolder folder;
    const std::string fine = edge(folder, "fine.exr", 6), coarse = edge(folder, "coarse.exr", 1);
    const std::string file = (folder / "rows.json").string();
    expect("compare " + fine + " " + coarse + " --metric perceived --panel rgb --json " + file, 0,
           "perceived scielab");
    const json row = rows(file)[0];
    EXPECT_EQ(row["reference"], fine);
    EXPECT_EQ(row["samples_per_pixel"], 6);
    ASSERT_EQ(row["perceived"].size(), 3u);
    const double error = row["perceived"][0]["error"];
    EXPECT_GT(error, 1);  // the whole pixel's colour fringe
    expect("compare " + coarse + " " + fine + " --metric perceived --panel rgb --max-perceived 0.5", 7,
           "perceived error");
    expect("compare " + coarse + " " + fine +
               " --metric perceived --panel off --eye scielab --max-perceived 0.5",
           0, "");
    const std::string map = (folder / "map.exr").string();
    expect("compare " + fine + " " + coarse + " --metric perceived --panel rgb --map " + map + " --map " +
               (folder / "map.png").string(),
           0, "");
    EXPECT_EQ(read_picture(map).width, 144u);
    EXPECT_NE(read_picture(map).find("red_green"), nullptr);
    EXPECT_EQ(read_picture(folder / "map.png").width, 144u);
}

TEST(PerceivedCommand, refuses_what_would_mean_nothing) {
    const TemporaryFolder folder;
    const std::string fine = edge(folder, "fine.exr", 3), coarse = edge(folder, "coarse.exr", 1),
                      made = edge(folder, "made.exr", 1, {{"triad:panel", "bgr"}});
    const std::string both = "compare " + fine + " " + coarse;
    expect(both + " --metric perceived", 1, "--panel");
    expect(both + " --panel rgb", 1, "--metric perceived");
    expect(both + " --metric perceived,rmse --panel rgb", 1, "apart");
    expect(both + " --metric perceived --panel rgb --map x.jpg", 1, "x.jpg");
    expect("compare " + coarse + " " + coarse + " --metric perceived --panel rgb", 7, "3 or more");
    expect("compare " + fine + " " + made + " --metric perceived --panel rgb", 1, "made for the panel bgr");
    expect("compare " + fine + " " + made + " --metric perceived --panel bgr", 0, "scielab");
    // a screen that stands upside down is not what its name alone says, but another screen
    const std::string turned = (folder / "turned.exr").string(), compare = "compare " + fine + " " + turned;
    expect("resolve " + fine + " --panel rgb@180 -o " + turned, 0, "");
    expect(compare + " --metric perceived --panel rgb", 1, "made for the panel rgb@180");
    expect(compare + " --metric perceived --panel rgb@180", 0, "scielab");
    expect(compare + " --metric perceived --panel bgr", 0, "scielab");
    expect("resolve " + fine + " --panel rgb -o " + (folder / "made.hdr").string(), 1,
           "cannot say which panel");
    const std::string scene = edge(folder, "scene.exr", 3, {{"triad:spp", "64"}});
    expect("compare " + scene + " " + turned + " --metric perceived --panel bgr", 0, "has scene values");
}

TEST(PanelCommand, draws_the_chart_of_all_panels) {
    const TemporaryFolder folder;
    const std::string file = (folder / "chart.png").string();
    expect("panel --test " + file, 0, "");
    EXPECT_GE(read_picture(file).width, 3 * 128u);
    expect("panel --test chart.gif", 1, "chart.gif");
}

TEST(PerceivedCommand, refuses_small_pictures_with_the_size_that_is_needed) {
    const TemporaryFolder folder;
    const std::string large = edge(folder, "large.exr", 3), small = edge(folder, "small.exr", 1);
    expect("compare " + large + " " + small + " --metric perceived --panel rgb --ppd 45", 0, "scielab");
    expect("compare " + large + " " + small + " --metric perceived --panel rgb --ppd 90", 7, "32 x 32");
}

TEST(CompareMaps, show_every_metric_where_the_pictures_differ) {
    const TemporaryFolder folder;
    const auto picture = [&](const std::string& name, float at_seven) {
        Picture p{40, 30, 0, 0, 0, 0, {}, {}};
        for (const char* channel : {"R", "G", "B"}) {
            p.channels.push_back({channel, std::vector<float>(40 * 30, 0.5f)});
            if (*channel == 'G') p.channels.back().values[7] = at_seven;
        }
        const std::string path = (folder / name).string();
        write_exr(path, p);
        return path;
    };
    const std::string a = picture("a.exr", 0.8f), b = picture("b.exr", 0.5f);
    const std::string map = (folder / "map.exr").string(), image = (folder / "map.png").string();
    for (const auto& [metric, value] : {std::pair("mae", 0.1),
                                        {"rmse", 0.3 / std::sqrt(3)},
                                        {"psnr", 0.3 / std::sqrt(3)},
                                        {"relmse", 0.03 / (0.25 + 0.01)}}) {
        expect("compare " + a + " " + b + " --metric " + metric + " --map " + map, 0, metric);
        const Picture read = read_picture(map);
        ASSERT_NE(read.find("error"), nullptr) << metric;
        EXPECT_NEAR(read.find("error")->values[7], value, 1e-6) << metric;
        EXPECT_EQ(read.find("error")->values[8], 0) << metric;
        EXPECT_EQ(read.metadata.at("triad:metric"), metric);
    }
    expect("compare " + a + " " + b + " --metric flip --map " + map + " --map " + image, 0, "flip");
    EXPECT_GT(read_picture(map).find("error")->values[7], 0.05);
    EXPECT_GT(read_picture(image).height, 40u) << "room for the bar";
    expect("compare " + a + " " + b + " --map x.jpg", 1, "x.jpg");
}

TEST(PanelCommand, drives_name_their_panel_in_every_format_that_can) {
    const TemporaryFolder folder;
    const std::string fine = edge(folder, "fine.exr", 3);
    for (const char* name : {"drives.png", "drives.exr"}) {
        const std::string file = (folder / name).string();
        expect("resolve " + fine + " --panel qd-oled --ppd 60 -o " + file, 0, "");
        const Metadata data = read_picture(file).metadata;
        EXPECT_EQ(data.at("triad:panel"), "qd-oled") << name;
        EXPECT_EQ(data.at("triad:panel_id"), panel_id(builtin_panel("qd-oled").value())) << name;
        EXPECT_EQ(data.at("triad:ppd"), "60") << name;
    }
}
