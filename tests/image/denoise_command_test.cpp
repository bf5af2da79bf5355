// What --denoise promises, through the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "expect_exit.h"
#include "io/io.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

TEST(DenoiseCommand, halves_the_error_and_says_so) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string(), raw = (folder / "raw.exr").string(),
                      own = (folder / "own.exr").string(), again = (folder / "again.exr").string();
    expect_exit(0, "render --size 128x72 --spp 16 --seed 3 --denoise own --film " + film + " -o " + own,
                "before own denoised it");
    expect_exit(0, "resolve " + film + " --denoise own -o " + again);
    expect_exit(0, "resolve " + film + " -o " + raw);
    EXPECT_EQ(read_picture(own).find("G")->values, read_picture(again).find("G")->values);
    const std::string reference = std::string(TRIAD_SCENES) + "/references/built-in.exr";
    expect_exit(7, "compare " + raw + " " + reference + " --max-relmse 0.03");
    expect_exit(0, "compare " + own + " " + reference + " --max-relmse 0.015");
    const Metadata metadata = read_picture(own).metadata, samples = read_picture(raw).metadata;
    EXPECT_EQ(metadata.at("triad:denoise"), "own");
    EXPECT_FALSE(metadata.contains("triad:relmse")) << "that of the samples, not of the picture";
    EXPECT_TRUE(samples.contains("triad:relmse"));
    EXPECT_FALSE(samples.contains("triad:denoise"));
}

TEST(DenoiseCommand, a_film_without_guides_is_denoised_by_colours) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string();
    expect_exit(0, "render --size 48x27 --spp 4 -q --film " + film);
    expect_exit(0, "resolve " + film + " --denoise own -o " + (folder / "a.png").string(), "colours alone");
}

TEST(DenoiseCommand, a_picture_for_a_panel_has_less_of_the_noise_that_an_eye_sees) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string(), reference = (folder / "r.png").string(),
                      own = (folder / "own.png").string(), off = (folder / "off.png").string();
    const std::string panel = " --panel rgb --ppd 30", scene = "render --size 48x32 ";
    expect_exit(0, "render --size 144x96 --spp 256 --seed 9 --bits 16 -q -o " + reference);
    expect_exit(0, scene + "--spp 18 --denoise own -q --film " + film + panel + " -o " + own);
    expect_exit(0, "resolve " + film + panel + " -q -o " + off);
    EXPECT_FALSE(read_picture(own).metadata.contains("triad:perceived_noise"));
    const auto error = [&](const std::string& picture) {
        const std::string report = (folder / "report.json").string();
        expect_exit(0, "compare " + picture + " " + reference + " --metric perceived --eye scielab" + panel +
                           " -q --json " + report);
        std::ifstream file(report);
        return nlohmann::json::parse(file)["rows"][0]["perceived"][0]["error"].get<double>();
    };
    EXPECT_LT(error(own), 0.85 * error(off));
}

TEST(DenoiseCommand, what_cannot_be_is_said_before_anything_is_rendered) {
    const TemporaryFolder folder;
    const std::string out = " -o " + (folder / "a.exr").string();
    expect_exit(1, "render --denoise strongly" + out, "off, own and oidn");
    expect_exit(1, "render --denoise own --spp 1" + out, "two halves");
    expect_exit(1, "render --denoise own --aov variance" + out, "tells of the samples");
    expect_exit(1, "render --denoise oidn --panel rgb" + out, "several bins");
    expect_exit(1, "render --denoise own --panel rgb --spp 9" + out, "two for each of its bins");
    expect_exit(1, "render --denoise own --pixel 3,4", "none is made");
    expect_exit(0, "render --size 16x9 --spp 4 -q" + out);
    expect_exit(1,
                "resolve " + (folder / "a.exr").string() + " --denoise own -o " + (folder / "b.exr").string(),
                "know their noise");
    EXPECT_FALSE(fs::exists(folder / "b.exr"));
}

TEST(DenoiseCommand, open_image_denoise_is_told_how_to_get_where_it_is_not) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string();
    expect_exit(0, "render --size 32x18 --spp 4 -q --denoise own --film " + film);
    const std::string resolve = "resolve " + film + " --denoise oidn -o " + (folder / "a.png").string();
    const Outcome missing = run_triad(resolve, "TRIAD_OIDN=/nowhere/libOpenImageDenoise.so");
    EXPECT_EQ(missing.exit, 3) << missing.output;
    EXPECT_NE(missing.output.find("TRIAD_OIDN"), std::string::npos) << missing.output;
    const Outcome found = run_triad(resolve);
    if (found.exit == 3) {  // it is not installed
        EXPECT_NE(found.output.find("pip install pyoidn"), std::string::npos) << found.output;
        return;
    }
    EXPECT_EQ(found.exit, 0) << found.output;
    EXPECT_EQ(read_picture(folder / "a.png").metadata.at("triad:denoise"), "oidn");
}
