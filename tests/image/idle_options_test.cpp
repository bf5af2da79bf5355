// Options that change nothing are told, and only these.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "expect_exit.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace {

const std::string scene = TRIAD_SCENES "/cornell/cornell.gltf";

void expect_nothing_told(const std::string& arguments) {
    const Outcome outcome = run_triad(arguments);
    EXPECT_EQ(outcome.exit, 0) << arguments << "\n" << outcome.output;
    EXPECT_EQ(outcome.output.find("warning"), std::string::npos) << arguments << "\n" << outcome.output;
}

}  // namespace

TEST(IdleOptions, of_files_that_are_not_written) {
    const TemporaryFolder folder;
    const std::string to = "render --size 8x8 --spp 9 -o " + (folder / "a").string();
    const std::string tones = "--exposure and --tonemap change nothing here";
    expect_exit(0, to + ".exr --exposure 1", tones);
    expect_exit(0, to + ".exr --exposure auto", tones);
    expect_exit(0, to + ".hdr --tonemap aces", tones);
    expect_exit(0, to + ".exr --filter box --exposure 1", tones);
    expect_exit(0, to + ".jpg --bits 16", "--bits changes nothing here: it is for .png.");
    expect_exit(0, to + ".png --half", "--half changes nothing here: it is for .exr.");
    expect_nothing_told(to + ".exr -o " + (folder / "b.png").string() + " --exposure 1 --bits 16 --half");
    expect_nothing_told(to + ".exr --panel rgb --exposure 1");
    expect_nothing_told(to + ".exr --reconstruct pane:2 --exposure 1");
    expect_nothing_told(to + ".JPG --tonemap aces");
    expect_nothing_told("render --size 8x8 --spp 1 --exposure 1 -o - --bits 16 > /dev/null");
}

TEST(IdleOptions, a_film_keeps_them) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string(), png = (folder / "a.png").string();
    expect_nothing_told("render --size 8x8 --spp 3 --exposure 1 --bits 16 --half --film " + film);
    std::filesystem::remove(film);
    expect_exit(
        0, "render --size 64x64 --time .3 --aperture .1 --focus 2 --panel rgb --refine 3 --film " + film);
    expect_nothing_told("render --resume " + film + " --time .1 --focus 2 --refine 3 -o " +
                        (folder / "b.exr").string());
}

TEST(IdleOptions, of_this_scene) {
    const TemporaryFolder folder;
    const std::string render = "render " + scene + " --size 16x12 --spp 2 -o " + (folder / "a.png").string();
    expect_exit(0, render + " --pose-time 2", "No animation moves the scene: --pose-time");
    expect_exit(0, render + " --pose-time 2 --animation none", "No animation moves the scene: --pose-time");
    expect_exit(0, render + " --frames 0:2", "No animation moves the scene: --pose-time and --frames");
    expect_exit(0, render + " --focus 2", "--focus changes nothing without --aperture");
    expect_exit(0, render + " --photons 100", "change nothing here: paths bring all light");
    expect_nothing_told(render + " --aperture .1 --focus 2 --integrator photons --photons 100");
}

TEST(IdleOptions, a_colour_behind_what_is_opaque) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string(), png = (folder / "a.png").string();
    const std::string behind = " -o " + (folder / "b.png").string() + " --background '#4080c0'";
    const auto told = [](const std::string& source) { return "nothing in " + source + " is transparent"; };
    expect_exit(0, "render --size 8x8 --spp 1 -o " + png + " --film " + film);
    expect_exit(0, "resolve " + film + behind, told(film));
    expect_exit(0, "resolve " + png + behind, told(png));
    std::filesystem::remove(film);
    expect_exit(0, "render --size 8x8 --spp 1 --background transparent -o " + png + " --film " + film);
    expect_nothing_told("resolve " + film + behind);
    expect_nothing_told("resolve " + png + behind);
}
