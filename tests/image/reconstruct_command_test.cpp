// What --reconstruct, --panel and triad resolve promise, through the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "io/io.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

Outcome done(const std::string& arguments, int exit = 0) {
    const Outcome outcome = run_triad(arguments);
    EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
    return outcome;
}

double worst_difference(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    double worst = 0;
    for (const char* name : {"R", "G", "B"})
        for (std::size_t i = 0; i < a.find(name)->values.size(); ++i)
            worst = std::max(worst, double(std::abs(a.find(name)->values[i] - b.find(name)->values[i])));
    return worst;
}

}  // namespace

TEST(ReconstructCommand, every_method_renders_with_its_bins_and_whole_rounds_of_samples) {
    const TemporaryFolder folder;
    const std::string out = " -o " + (folder / "a.exr").string();
    struct Case {
        const char *options, *samples, *panel;
    };
    for (const Case& c : {Case{"--reconstruct centre", "4", nullptr},
                          {"--reconstruct ssaa:2", "4", nullptr},
                          {"--reconstruct pane:3", "9", nullptr},
                          {"--reconstruct pane-encoded:2", "4", nullptr},
                          {"--filter mitchell --bins 2x2", "4", nullptr},
                          {"--reconstruct subpixel3", "6", nullptr},
                          {"--reconstruct random3 --panel rgb", "6", "rgb"},
                          {"--reconstruct random3:shared --panel rgb", "4", "rgb"},
                          {"--reconstruct platt --panel rgb", "6", "rgb"},
                          {"--reconstruct displaced --panel bgr", "9", "bgr"},
                          {"--panel pentile", "9", "pentile"}}) {
        done("render --size 24x16 --spp 4 " + std::string(c.options) + out);
        const Picture picture = read_picture(folder / "a.exr");
        EXPECT_EQ(picture.metadata.at("triad:spp"), c.samples) << c.options;
        EXPECT_EQ(picture.metadata.count("triad:panel"), c.panel ? 1u : 0u) << c.options;
        if (c.panel) {
            EXPECT_EQ(picture.metadata.at("triad:panel"), c.panel);
            EXPECT_EQ(picture.metadata.at("triad:ppd"), "45");
            EXPECT_EQ(picture.metadata.at("triad:values"), "display-linear");
        }
        for (const Channel& channel : picture.channels)
            for (const float v : channel.values) ASSERT_TRUE(std::isfinite(v)) << c.options;
    }
}

TEST(ReconstructCommand, a_film_for_a_panel_is_the_picture_that_was_rendered_for_it) {
    const TemporaryFolder folder;
    const std::string film = (folder / "f").string();
    done("render --size 24x16 --spp 9 --bins 3x3 --film " + film + " -o " + (folder / "plain.exr").string());
    done("render --size 24x16 --spp 9 --panel qd-oled --ppd 60 -o " + (folder / "rendered.exr").string());
    done("resolve " + film + " --panel qd-oled --ppd 60 -o " + (folder / "resolved.exr").string());
    EXPECT_EQ(worst_difference(read_picture(folder / "rendered.exr"), read_picture(folder / "resolved.exr")),
              0.0);
    const Picture plain = read_picture(folder / "plain.exr");  // never for a panel by itself
    EXPECT_EQ(plain.metadata.count("triad:panel"), 0u);
    EXPECT_EQ(plain.metadata.count("triad:values"), 0u);
    EXPECT_GT(*std::max_element(plain.find("R")->values.begin(), plain.find("R")->values.end()), 1.0f)
        << "scene-linear";
    done("resolve " + film + " --panel qd-oled -o " + (folder / "x.hdr").string(), 1);
    const Outcome outcome =
        done("resolve " + film + " --reconstruct ssaa:2 -o " + (folder / "x.png").string(), 1);
    EXPECT_NE(outcome.output.find("2x2"), std::string::npos) << outcome.output;
    done("resolve " + film + " --reconstruct random3:shared --panel rgb -o " + (folder / "x.png").string(),
         1);
}

TEST(ReconstructCommand, rays_by_a_filter_are_resolved_by_their_method_alone) {
    const TemporaryFolder folder;
    const std::string film = (folder / "f").string(), out = " -o " + (folder / "x.exr").string();
    done("render --size 16x16 --spp 3 --reconstruct random3 --panel rgb --film " + film + out);
    EXPECT_NE(done("resolve " + film + out, 1).output.find("random3"), std::string::npos);
    done("resolve " + film + " --reconstruct random3 --panel rgb" + out);
}

TEST(ReconstructCommand, any_larger_picture_is_filtered_for_a_panel) {
    const TemporaryFolder folder;
    const auto path = [&](const char* name) { return (folder / name).string(); };
    Picture big;
    big.width = 31, big.height = 22;  // no multiple of 3
    for (const char* name : {"R", "G", "B"}) {
        big.channels.push_back({name, {}});
        for (unsigned i = 0; i < 31 * 22; ++i)
            big.channels.back().values.push_back(i % 31 < 15 ? 0.25f : 0.5f);
    }
    write_exr(folder / "big.exr", big);
    done("resolve " + path("big.exr") + " --tonemap none --panel qd-oled -o " + path("a.exr"));
    const Picture drives = read_picture(folder / "a.exr");
    EXPECT_EQ(drives.width, 11u);
    EXPECT_EQ(drives.height, 8u);
    EXPECT_NEAR(drives.find("G")->values[0], 0.25, 1e-5);
    EXPECT_NEAR(drives.find("G")->values[10], 0.5, 1e-5);
    EXPECT_EQ(drives.metadata.at("triad:panel"), "qd-oled");
    // A filter without a panel gives scene-linear values; the same picture in 8 bits is tone-mapped already.
    done("resolve " + path("big.exr") + " --filter box --bins 3x3 -o " + path("box.exr") + " -o " +
         path("box.png") + " --tonemap none");
    const Picture box = read_picture(folder / "box.exr");
    EXPECT_NEAR(box.find("R")->values[0], 0.25, 1e-6);
    EXPECT_EQ(box.metadata.count("triad:values"), 0u);
    done("resolve " + path("box.png") + " --bins 1x1 -o " + path("again.png"));
    EXPECT_EQ(worst_difference(read_picture(folder / "again.png"), read_picture(folder / "box.png")), 0.0);
    EXPECT_NE(
        done("resolve " + path("box.png") + " --exposure 1 -o " + path("x.png"), 1).output.find("--exposure"),
        std::string::npos);
}

TEST(ReconstructCommand, an_automatic_exposure_is_that_of_the_film_and_is_told) {
    const TemporaryFolder folder;
    const auto path = [&](const char* name) { return (folder / name).string(); };
    done("render --size 48x32 --spp 4 --film " + path("a.triadfilm") + " -o " + path("as_it_is.exr"));
    const Outcome told = done("resolve " + path("a.triadfilm") + " --exposure auto -o " + path("auto.png") +
                              " -o " + path("auto.exr"));
    const std::string chosen = read_picture(folder / "auto.png").metadata.at("triad:exposure");
    EXPECT_NE(told.output.find("Exposure " + std::string(chosen[0] == '-' ? "" : "+") + chosen),
              std::string::npos)
        << told.output;
    done("resolve " + path("a.triadfilm") + " --exposure " + chosen + " -o " + path("given.png"));
    EXPECT_EQ(worst_difference(read_picture(folder / "auto.png"), read_picture(folder / "given.png")), 0.0);
    // Scene-linear values have no exposure. Those of a film and of its picture are the same light.
    EXPECT_EQ(read_picture(folder / "auto.exr").metadata.count("triad:exposure"), 0u);
    EXPECT_EQ(worst_difference(read_picture(folder / "auto.exr"), read_picture(folder / "as_it_is.exr")),
              0.0);
    done("resolve " + path("auto.exr") + " --bins 1x1 --exposure auto -o " + path("of_exr.png"));
    EXPECT_EQ(read_picture(folder / "of_exr.png").metadata.at("triad:exposure"), chosen);
    for (const char* bad : {"bright", "nan", "1e9", "3x", "--"})
        EXPECT_NE(done(std::string("resolve ") + path("a.triadfilm") + " --exposure=" + bad + " -o " +
                           path("bad.png"),
                       1)
                      .output.find("auto, or a number from -64 to 64"),
                  std::string::npos)
            << bad;
}

TEST(ReconstructCommand, the_bench_says_where_it_finds_no_pictures) {
    const TemporaryFolder folder;
    const std::string empty = (folder / "").string(), absent = (folder / "absent").string();
    EXPECT_NE(
        done("bench subpixel --synthetic " + absent, 2).output.find(absent + ": there is no such folder"),
        std::string::npos);
    EXPECT_NE(done("bench subpixel --synthetic " + empty, 2).output.find("no .exr file"), std::string::npos);
}

TEST(ReconstructCommand, pictures_for_a_panel_are_refused_where_they_would_be_taken_for_colours) {
    const TemporaryFolder folder;
    const auto path = [&](const char* name) { return (folder / name).string(); };
    done("render --size 16x16 --spp 9 --panel rgb -o " + path("p.exr") + " -o " + path("p.png") + " -o " +
         path("p.jpg"));
    done("render --size 16x16 --spp 4 -o " + path("q.exr"));
    for (const char* name : {"p.exr", "p.png", "p.jpg"}) {
        for (const std::string& arguments :
             {"compare " + path(name) + " " + path("q.exr"), "compare " + path("q.exr") + " " + path(name),
              "merge " + path(name) + " -o " + path("m"), "resolve " + path(name) + " -o " + path("r.png")}) {
            const Outcome outcome = done(arguments, 1);
            EXPECT_NE(outcome.output.find("made for the panel rgb"), std::string::npos) << arguments << "\n"
                                                                                        << outcome.output;
        }
    }
}
