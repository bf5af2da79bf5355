// What triad render promises about its options and files, through the command line and on the built-in scene.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "io/io.h"
#include "program.h"
#include "running.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;
using nlohmann::json;

namespace {

void expect_done(const std::string& arguments, int exit = 0) {
    const Outcome outcome = run_triad(arguments);
    ASSERT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
}

float value(const Picture& picture, const std::string& channel, unsigned x, unsigned y) {
    return picture.find(channel)->values[std::size_t(y) * picture.width + x];
}

}  // namespace

TEST(RenderCommand, json_tells_the_phases_and_how_it_ended) {
    const TemporaryFolder folder;
    // The first use of a device renders what checks it, with phases of its own.
    ASSERT_EQ(run_triad("render --size 32x18 --spp 1 -q -o " + (folder / "a.png").string()).exit, 0);
    const Outcome done =
        run_triad("render --size 32x18 --spp 2 --progress json -o " + (folder / "a.png").string());
    ASSERT_EQ(done.exit, 0) << done.output;
    std::string phases;
    json last;
    std::istringstream lines(done.output);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("{")) continue;
        last = json::parse(line);
        if (last.contains("phase")) phases += last["phase"].get<std::string>() + " ";
    }
    EXPECT_EQ(phases, "load device build compile render write end ");
    EXPECT_EQ(last.at("exit"), 0);
    const Outcome failed =
        run_triad("render --progress json '" + (folder / "no \"scene\".glb").string() + "'");
    ASSERT_EQ(failed.exit, 2) << failed.output;
    const std::size_t end = failed.output.find("{\"phase\": \"end\"");
    ASSERT_NE(end, std::string::npos) << failed.output;
    std::istringstream rest(failed.output.substr(end));
    std::string line;
    std::getline(rest, line);
    const auto event = json::parse(line);
    EXPECT_EQ(event.at("exit"), 2);
    EXPECT_NE(event.at("error").get<std::string>().find("no \"scene\".glb"), std::string::npos);
}

TEST(RenderCommand, an_interrupt_finishes_the_pass_and_saves) {
    const TemporaryFolder folder;
    const fs::path picture = folder / "a.exr", film = folder / "a.film";
    Running render("render --size 64x36 --spp 1000000 --progress json -o " + picture.string() + " --film " +
                   film.string());
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    render.interrupt();
    EXPECT_TRUE(render.says("Stopped early")) << render.said();
    EXPECT_EQ(render.wait(), 75) << render.said();
    const Film saved = load_film(film);
    ASSERT_EQ(saved.ranges.size(), 1u);
    EXPECT_EQ(saved.ranges[0].begin, 0u);
    EXPECT_LT(saved.ranges[0].end, 1000000u);
    for (const std::uint32_t samples : saved.samples) ASSERT_EQ(samples, saved.ranges[0].end);
    EXPECT_EQ(read_picture(picture).metadata.at("triad:spp"), std::to_string(saved.ranges[0].end));
}

TEST(RenderCommand, a_second_interrupt_quits_at_once) {
    const TemporaryFolder folder;
    // One pass over so many pixels takes many seconds.
    Running render("render --size 6000x4000 --spp 1 -v --progress none -o " + (folder / "a.png").string());
    ASSERT_TRUE(render.says("Not needed by this scene")) << render.said();
    ::usleep(500000);  // from that line to the handler is a few instructions
    render.interrupt();
    ASSERT_TRUE(render.says("once more to quit")) << render.said();
    render.interrupt();
    EXPECT_EQ(render.wait(), 130) << render.said();
    EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(RenderCommand, every_layer_is_there_and_means_what_it_says) {
    const TemporaryFolder folder;
    const fs::path path = folder / "a.exr";
    expect_done("render --size 32x18 --spp 6 --seed 7 --aov all -o " + path.string());
    const Picture picture = read_picture(path);
    for (const char* name : {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y",
                             "normal.Z", "position.X", "position.Y", "position.Z", "depth.Z", "samplecount.Y",
                             "variance.R", "variance.G", "variance.B", "error.Y"})
        ASSERT_NE(picture.find(name), nullptr) << name;
    for (const char* name : {"version", "spp", "relmse", "scene", "scene_name", "settings", "settings_text",
                             "seed", "seconds", "rays", "device", "driver", "compute_units", "machine"})
        EXPECT_FALSE(picture.metadata.at("triad:" + std::string(name)).empty()) << name;
    EXPECT_EQ(picture.metadata.at("triad:seed"), "7");
    EXPECT_EQ(picture.metadata.at("triad:spp"), "6");
    EXPECT_GT(std::stod(picture.metadata.at("triad:relmse")), 0);
    unsigned covered = 0;
    for (unsigned y = 0; y < picture.height; ++y)
        for (unsigned x = 0; x < picture.width; ++x) {
            EXPECT_EQ(value(picture, "samplecount.Y", x, y), 6);
            EXPECT_GE(value(picture, "variance.G", x, y), 0);
            EXPECT_GE(value(picture, "albedo.R", x, y), 0);
            EXPECT_LE(value(picture, "albedo.R", x, y), 1);
            const float nx = value(picture, "normal.X", x, y), ny = value(picture, "normal.Y", x, y),
                        nz = value(picture, "normal.Z", x, y);
            EXPECT_LT(nx * nx + ny * ny + nz * nz, 1.001f);
            covered += value(picture, "depth.Z", x, y) > 0;
        }
    EXPECT_GT(covered, picture.width * picture.height / 2) << "the built-in scene has a floor";
}

TEST(RenderCommand, a_pixel_is_that_of_the_picture) {
    const TemporaryFolder folder;
    const std::string size = "render --size 32x18 --spp 40 --seed 3 ";
    expect_done(size + "--aov variance -o " + (folder / "a.exr").string());
    const Outcome told = run_triad(size + "--pixel 13,11 --json " + (folder / "p.json").string());
    ASSERT_EQ(told.exit, 0) << told.output;
    for (const char* part :
         {"pixel 13, 11: 40 samples", "variance of the mean", "edges", "environment", "largest samples"})
        EXPECT_NE(told.output.find(part), std::string::npos) << part << "\n" << told.output;
    const Picture picture = read_picture(folder / "a.exr");
    const auto row = json::parse(bytes_of(folder / "p.json")).at("rows").at(0);
    const char* const channels[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(row.at("mean").at(c).get<float>(), value(picture, channels[c], 13, 11), 1e-5);
        const float variance = value(picture, std::string("variance.") + channels[c], 13, 11);
        EXPECT_NEAR(row.at("mean_variance").at(c).get<float>(), variance, 1e-4 * variance + 1e-9);
    }
    EXPECT_FALSE(fs::exists("triad.png"));
    EXPECT_EQ(run_triad(size + "--pixel 32,0").exit, 1);
}

TEST(RenderCommand, an_error_or_a_time_ends_it_and_the_metadata_say_how) {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& goal) {
        expect_done("render --size 64x36 --aov samples,error " + goal + " -o " + (folder / "a.exr").string() +
                    " --json " + (folder / "a.json").string());
        return std::pair{read_picture(folder / "a.exr"),
                         json::parse(bytes_of(folder / "a.json")).at("rows").at(0)};
    };
    const auto [picture, row] = render("--error 0.05 --adaptive on");
    EXPECT_EQ(row.at("stopped_by"), "error");
    EXPECT_LE(row.at("relmse").get<double>(), 1.02 * 0.05);
    EXPECT_EQ(picture.metadata.at("triad:stopped_by"), "error");
    double samples = 0, error = 0, least = 1e9, most = 0;
    for (unsigned y = 0; y < picture.height; ++y)
        for (unsigned x = 0; x < picture.width; ++x) {
            const double n = value(picture, "samplecount.Y", x, y);
            samples += n, error += value(picture, "error.Y", x, y);
            least = std::min(least, n), most = std::max(most, n);
        }
    EXPECT_LT(least, most);
    EXPECT_EQ(std::stod(picture.metadata.at("triad:samples")), samples);
    EXPECT_NEAR(std::stod(picture.metadata.at("triad:spp")), samples / (64 * 36), 1e-6);
    EXPECT_EQ(std::stod(picture.metadata.at("triad:spp_min")), least);
    EXPECT_EQ(std::stod(picture.metadata.at("triad:spp_max")), most);
    EXPECT_NEAR(std::stod(picture.metadata.at("triad:relmse")), error / (64 * 36), 1e-6);
    const auto even = render("--error 0.05 --adaptive off").second;
    EXPECT_EQ(even.at("spp_min"), even.at("spp_max"));
    EXPECT_TRUE(even.at("spp").is_number_integer());
    EXPECT_EQ(render("--error 0.000001 --spp 6").second.at("stopped_by"), "samples");
    EXPECT_EQ(render("--error 0.000001 --time 0.5").second.at("stopped_by"), "time");
}

TEST(RenderCommand, a_film_is_the_same_with_every_format_of_nodes_and_merges) {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& format, const std::string& samples) {
        const fs::path file = folder / (format + samples);
        expect_done("render --size 32x18 --samples " + samples + " --format " + format + " --film " +
                    file.string() + ".film -o " + file.string() + ".exr --json " + file.string() + ".json");
        EXPECT_EQ(read_picture(file.string() + ".exr").metadata.at("triad:format"), format);
        EXPECT_EQ(json::parse(bytes_of(file.string() + ".json")).at("rows").at(0).at("format"), format);
        return file.string() + ".film";
    };
    const std::string eight = render("bvh8", "0:4");
    EXPECT_EQ(bytes_of(eight), bytes_of(render("bvh4", "0:4")));
    const std::string merged = (folder / "merged.film").string();
    expect_done("merge " + render("bvh8", "0:1") + " " + render("bvh4", "1:4") + " -o " + merged);
    EXPECT_EQ(bytes_of(merged), bytes_of(eight));
}

TEST(RenderCommand, a_crop_is_a_part_of_the_picture) {
    const TemporaryFolder folder;
    expect_done("render --size 32x18 --spp 2 -o " + (folder / "whole.exr").string());
    expect_done("render --size 32x18 --spp 2 --crop 3,5,20,7 -o " + (folder / "crop.exr").string());
    const Picture whole = read_picture(folder / "whole.exr"), crop = read_picture(folder / "crop.exr");
    ASSERT_EQ(crop.width, 20u);
    ASSERT_EQ(crop.height, 7u);
    EXPECT_EQ(crop.x, 3u);
    EXPECT_EQ(crop.y, 5u);
    EXPECT_EQ(crop.full_width, 32u);
    EXPECT_EQ(crop.full_height, 18u);
    for (unsigned y = 0; y < 7; ++y)
        for (unsigned x = 0; x < 20; ++x)
            ASSERT_EQ(value(crop, "G", x, y), value(whole, "G", x + 3, y + 5)) << x << ", " << y;
    EXPECT_EQ(run_triad("render --size 32x18 --crop 13,5,20,7 -o " + (folder / "x.exr").string()).exit, 1);
}

TEST(RenderCommand, half_rounds_what_float_holds) {
    const TemporaryFolder folder;
    const std::string render = "render --size 32x18 --spp 2 -o " + (folder / "").string();
    expect_done(render + "float.exr");
    expect_done(render + "half.exr --half");
    const Picture wide = read_picture(folder / "float.exr"), narrow = read_picture(folder / "half.exr");
    unsigned rounded = 0;
    for (std::size_t i = 0; i < wide.find("G")->values.size(); ++i) {
        const float a = wide.find("G")->values[i], b = narrow.find("G")->values[i];
        ASSERT_NEAR(a, b, std::abs(a) * 0x1p-11f + 0x1p-25f);
        rounded += a != b;
    }
    EXPECT_GT(rounded, 0u);
}

TEST(RenderCommand, the_environment_turns_from_x_towards_z_and_scales) {
    const TemporaryFolder folder;
    // Quarters of the horizon centred on -x, -z, +x, +z: u = 0, .25, .5, .75.
    Picture map;
    map.width = 64, map.height = 32;
    map.channels = {{"R", {}}, {"G", {}}, {"B", {}}};
    for (unsigned y = 0; y < map.height; ++y)
        for (unsigned x = 0; x < map.width; ++x) {
            const unsigned quarter = (x + 8) % 64 / 16;
            for (unsigned c = 0; c < 3; ++c) map.channels[c].values.push_back(quarter == c ? 1.0f : 0.0f);
        }
    const std::string file = (folder / "map.exr").string();
    write_exr(file, map);
    // Far above the scene, looking level: nothing but the environment is in view.
    const auto seen = [&](const std::string& towards, const std::string& options) {
        const std::string out = (folder / "seen.exr").string();
        expect_done("render --size 4x4 --spp 1 --fov 5 --look-at 0,1000,0," + towards + " --env " + file +
                    " " + options + " -o " + out);
        const Picture picture = read_picture(out);
        return std::array{value(picture, "R", 1, 1), value(picture, "G", 1, 1), value(picture, "B", 1, 1)};
    };
    using Colour = std::array<float, 3>;
    EXPECT_EQ(seen("-1,1000,0", ""), (Colour{1, 0, 0}));
    EXPECT_EQ(seen("0,1000,-1", ""), (Colour{0, 1, 0}));
    EXPECT_EQ(seen("1,1000,0", ""), (Colour{0, 0, 1}));
    EXPECT_EQ(seen("0,1000,1", ""), (Colour{0, 0, 0}));
    EXPECT_EQ(seen("0,1000,1", "--env-rotate 90 --env-strength 2"), (Colour{0, 0, 2}));
    EXPECT_EQ(seen("0,1000,-1", "--env-rotate 90"), (Colour{1, 0, 0}));
    expect_done("render --size 4x4 --spp 1 --look sky --env-rotate 90 " TRIAD_SCENES "/suite/glass.glb -o " +
                (folder / "a.png").string());
    EXPECT_EQ(
        run_triad("render --size 4x4 --spp 1 --env-rotate 90 " TRIAD_SCENES "/cornell/cornell.gltf -o " +
                  (folder / "a.png").string())
            .exit,
        1);
}

TEST(RenderCommand, the_background_is_transparent_or_the_colour_asked_for) {
    const TemporaryFolder folder;
    const std::string render =
        "render --size 4x4 --look-at 0,1000,0,1,1000,0 -o " + (folder / "a.png").string();
    expect_done(render + " --background transparent --spp 1");
    Picture picture = read_picture(folder / "a.png");
    ASSERT_NE(picture.find("A"), nullptr);
    EXPECT_EQ(value(picture, "A", 2, 2), 0);
    for (const std::string method :
         {"--spp 1", "--reconstruct centre", "--reconstruct ssaa:2", "--filter box --bins 1x1",
          "--filter gaussian", "--filter lanczos", "--filter tent --panel rgb",
          "--reconstruct random3 --panel rgb", "--reconstruct random3:shared --panel rgb",
          "--reconstruct pane:2", "--reconstruct pane-encoded:2", "--reconstruct subpixel3 --panel rgb",
          "--filter gaussian --spp 18 --denoise own"}) {
        expect_done(render + " --background '#4080c0' " + method);
        picture = read_picture(folder / "a.png");
        EXPECT_EQ(picture.find("A"), nullptr);
        EXPECT_EQ(std::lround(255 * value(picture, "R", 2, 2)), 0x40) << method;
        EXPECT_EQ(std::lround(255 * value(picture, "G", 2, 2)), 0x80) << method;
        EXPECT_EQ(std::lround(255 * value(picture, "B", 2, 2)), 0xc0) << method;
    }
}

TEST(RenderCommand, a_full_disk_is_a_sentence_and_leaves_the_older_picture) {
    const TemporaryFolder folder;
    const fs::path picture = folder / "a.exr";
    const std::string render = "render --size 800x450 --spp 1 -o " + picture.string();
    expect_done(render);
    const std::string older = bytes_of(picture);
    // A limit on the size of files is the disk that fills up; drivers write smaller ones while they compile.
    ASSERT_GT(older.size(), 2u << 20);
    const Outcome outcome = run_triad(render + " --seed 2", "ulimit -f 4096;");  // blocks of 512 bytes
    EXPECT_EQ(outcome.exit, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("a.exr"), std::string::npos) << outcome.output;
    EXPECT_TRUE(bytes_of(picture) == older);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), {}), 1) << "something was left behind";
    EXPECT_EQ(run_triad("render --size 8x8 --spp 1 -q -o - > /dev/full").exit, 2);
}
