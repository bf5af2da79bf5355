// What the command line promises: exit codes, and sentences that name what is wrong. Nothing here needs a
// device.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;

namespace {

void expect(const std::string& arguments, int exit, const std::string& sentence,
            const std::string& before = "") {
    const Outcome outcome = run_triad(arguments, before);
    EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << arguments << "\n" << outcome.output;
}

}  // namespace

TEST(CommandLine, help_and_version_are_no_errors) {
    expect("", 0, "render");
    expect("render --help", 0, "--spp");
    expect("--version", 0, "triad ");
}

TEST(CommandLine, slips_get_a_hint) {
    expect("rendr", 1, "Did you mean render?");
    expect("render --sp=4", 1, "Did you mean --spp?");
    expect("render --nothing-like-it", 1, "triad render --help");
}

TEST(CommandLine, bad_values_are_named) {
    expect("render --size 0x9", 1, "--size 0x9");
    expect("render --size 12y", 1, "--size 12y");
    expect("render --samples 4:4", 1, "--samples 4:4");
    expect("render --look-at 1,2,3", 1, "--look-at 1,2,3");
    expect("render --background '#12345g'", 1, "#12345g");
    expect("render --tonemap filmic", 1, "filmic");
    expect("render --spp none", 1, "none");
    expect("render --max-memory 4X", 1, "--max-memory 4X");
    expect("render --max-memory 0", 1, "--max-memory 0");
    expect("render --samples share:2/2 --spp 4", 1, "share:2/2");
    expect("render --samples share:0/2", 1, "--spp N");
    expect("render --checkpoint 5", 1, "--film");
    expect("render --crop 0,0,0,5", 1, "--crop");
    expect("render --error 0", 1, "--error");
    expect("render --time -1", 1, "--time");
    expect("render --adaptive maybe", 1, "--adaptive maybe");
    expect("render --samples 0:8 --error 0.1", 1, "--samples");
    expect("render --samples 0:8 --adaptive on", 1, "--samples");
    expect("render --pixel 3", 1, "--pixel 3");
    expect("render --pixel 3,4 --error 0.1", 1, "--pixel makes no picture");
    expect("render --pixel 3,4 -o x.png", 1, "--pixel makes no picture");
    expect("render -o picture.bmp", 1, "picture.bmp");
    expect("render --aov normal -o x.png", 1, "--aov");
    expect("render --camera no-such-camera", 1, "no-such-camera");
    expect("render --format bvh16", 1, "--format bvh16");
    expect("check --format no", 1, "--format no: expected bvh8 or bvh4");
}

TEST(CommandLine, a_number_that_is_not_whole_or_too_large_is_told_what_is_taken) {
    const std::string wanted = "expected a whole number from 0 to 4294967295, not ";
    for (const std::string option : {"--seed", "--threads", "--max-depth"}) {
        for (const std::string number : {"-1", "4294967296", "99999999999999999999", "1.5", "many"})
            expect("render " + option + " " + number, 1, option + ": " + wanted + number);
        expect("render -o x.bmp " + option + " 4294967295", 1, "x.bmp");
    }
    expect("check --threads -1", 1, "--threads: " + wanted + "-1");
    for (const std::string number : {"1e3", "0", "-1", "1073741825", "99999999999999999999"})
        expect("render --spp " + number, 1,
               "--spp: expected a whole number from 1 to 1073741824, not " + number);
    expect("info a.glb --scene -1", 1, "--scene: expected a whole number from 0 to 2147483647, not -1");
}

TEST(CommandLine, numbers_that_float_cannot_work_with_are_named) {
    expect("render --look-at 1e300,0,0,0,0,0", 1, "--look-at 1e300,0,0,0,0,0");
    expect("render --look-at 0,0,0,0,-2e12,0", 1, "up to 1e+12");
    expect("render --aperture 1e300", 1, "--aperture: expected a number from 0 to 1e+12");
    expect("render --aperture 1e12 --focus 1e-12", 1, "--aperture");
    expect("render --focus 1e300", 1, "--focus");
    expect("render --env-strength 1e39", 1, "--env-strength");
    for (const std::string option : {"aperture", "focus", "fov", "roulette", "env-strength", "exposure",
                                     "time", "error", "photon-radius", "distance", "ppd"})
        expect("render --" + option + " nan", 1, "--" + option);
    expect("compare a.exr b.exr --max-rmse nan", 1, "--max-rmse");
}

TEST(CommandLine, missing_files_are_scene_errors) {
    expect("render /no/such/file.glb", 2, "/no/such/file.glb");
    expect("info /no/such/file.glb", 2, "/no/such/file.glb");
    expect("merge /no/such.film -o /tmp/x.triadfilm", 2, "/no/such.film");
    expect("compare /no/such.exr /no/such.exr", 2, "/no/such.exr");
}

TEST(CommandLine, a_folder_is_no_scene_whatever_is_below_it) {
    const TemporaryFolder folder;
    const std::string above = folder.path().string(), below = (folder / "below").string();
    fs::create_directory(below);
    const std::string there = "cd '" + below + "' &&";
    std::ofstream(folder / "below/x.png") << "a picture";
    for (const std::string& arguments :
         {"render " + above + " -o x.png", "info " + above + " --json x.png",
          "capture " + above + " -o x.png", "profile " + above + " --json x.png"})
        expect(arguments, 2, above + " is a folder, not a scene", there);
    EXPECT_EQ(bytes_of(folder / "below/x.png"), "a picture");
}

TEST(CommandLine, what_info_refuses_it_tells_in_its_json) {
    const TemporaryFolder folder;
    const std::string scene = (folder / "bad.gltf").string(), json = (folder / "a.json").string();
    std::ofstream(scene) << "{";
    expect("info " + scene + " --json -", 2, "\"error\": \"" + scene);
    expect("info " + scene + " --json " + json, 2, "JSON");
    EXPECT_NE(bytes_of(json).find("\"exit\": 2"), std::string::npos);
    // What is there may be a file of the scene.
    std::ofstream(json) << "older";
    expect("info " + scene + " --json " + json, 2, "JSON");
    EXPECT_EQ(bytes_of(json), "older");
}

TEST(CommandLine, outputs_are_checked_before_rendering) {
    expect("render -o /no/such/folder/x.png --spp 1000000", 2, "/no/such/folder");
    expect("render -o /tmp --spp 1000000", 1, "/tmp");
    expect("render -o /proc/x.png --spp 1000000", 2, "Cannot write /proc/x.png:");
    expect("render --film /no/such/folder/x --spp 1000000", 2, "/no/such/folder");
}

TEST(CommandLine, no_driver_is_a_device_error) {
    expect("render --size 8x8 -o /tmp/triad-cli-test.png", 5, "OpenCL", "OCL_ICD_VENDORS=/no/such/folder");
    expect("devices", 5, "OpenCL", "OCL_ICD_VENDORS=/no/such/folder");
}

TEST(CommandLine, the_list_of_cases_asks_no_device) {
    expect("check --list", 0, "M1 sin and cos", "OCL_ICD_VENDORS=/no/such/folder");
    expect("check --list --json -", 1, "--list prints the cases and checks nothing: leave --json out");
    expect("check --quick --full", 1, "--quick");
    expect("check --first --full", 1, "--f");
    expect("check --first --case C1", 1, "--first");
}

TEST(CommandLine, a_case_that_is_not_there_is_found_before_a_device_is_asked) {
    expect("check --case C1,ZZ", 1, "There is no case ZZ; triad check --list prints all of them.",
           "OCL_ICD_VENDORS=/no/such/folder");
}

TEST(CommandLine, a_pixel_is_of_one_scene) {
    expect("render a.glb b.glb --pixel 3,4", 1, "--pixel takes one scene, and here are 2.");
}

TEST(CommandLine, options_for_every_run_of_a_bench_override_those_of_its_scenes) {
    expect("bench --options '--size 0x9'", 1, "--size 0x9");
    expect("bench error 'a: --size 8x8' --options '--size 0x9'", 1, "--size 0x9");
}

TEST(CommandLine, a_full_disk_leaves_an_older_report_as_it_was) {
    const fs::path folder = fs::temp_directory_path() / ("triad-cli-test-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const std::string report = (folder / "devices.json").string();
    std::ofstream(report) << "older";
    // A file size limit of nothing is the disk that fills up at the first byte.
    expect("devices --json " + report, 2, "devices.json", "ulimit -f 0;");
    std::ifstream file(report);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "older");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "something was left behind";
    fs::remove_all(folder);
    EXPECT_EQ(run_triad("devices --json - >/dev/full").exit, 2);
}

TEST(CommandLine, reconstruction_that_makes_no_sense_is_refused) {
    expect("render --reconstruct triads", 1, "pane-encoded:N");
    expect("render --reconstruct triad", 1, "--panel");
    expect("render --reconstruct ssaa:40", 1, "1 to 16");
    expect("render --reconstruct pane:2 --panel rgb", 1, "leave --panel out");
    expect("render --filter bos", 1, "blackman-harris");
    expect("render --filter box:0", 1, "above 0");
    expect("render --panel no-such-panel", 1, "no-such-panel");
    expect("render --ppd 45", 1, "--panel");
    expect("render --refine 3", 1, "--panel");
    expect("render --panel rgb --distance 600", 1, "--pitch");
    expect("render --panel rgb --bins 17x17", 1, "16x16");
    expect("render --bins 3x3 --samples 0:10", 1, "multiples of 9");
    expect("resolve /no/such/file.png -o /tmp/x.png", 2, "/no/such/file.png");
}
