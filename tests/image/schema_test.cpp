// What is written as JSON is what docs/schema describes. Profiles, replays and boards are compared where they
// are tested.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "json_schema.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;

namespace {

class Schemas : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string run(const std::string& arguments, int exit = 0) const {
        const Outcome outcome = run_triad(arguments);
        EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
        return outcome.output;
    }
    /// The lines of JSON that the command prints.
    void expect_lines(const std::string& arguments, int exit = 0) const {
        std::ofstream(path("lines")) << run(arguments + " --progress json", exit);
        expect_schema("progress", path("lines"), true);
    }
    /// Of the command with --json.
    void expect_report(const std::string& name, const std::string& arguments, int exit = 0) const {
        const std::string json = path("report.json");
        fs::remove(json);
        run(arguments + " --json " + json, exit);
        expect_schema(name, json);
    }

    triad::TemporaryFolder folder_;
    const std::string knot = TRIAD_SCENES "/suite/knot.glb", small = " --size 32x32 --spp 2 -q ";
};

}  // namespace

TEST_F(Schemas, describe_renders_films_and_their_progress) {
    const std::string film = path("a.film");
    expect_lines("render " + knot + " --size 32x32 --spp 2 --film " + film + " -o " + path("a.exr"));
    expect_report("render", "render " + knot + small + "-o " + path("b.exr"));
    expect_report("render", "render " + knot + small + "--panel rgb --time 0.1 -o " + path("panel.exr"));
    expect_report("render", "render " + knot + small + "--spectral full --pixel 9,9 >/dev/null");
    expect_report("info", "info " + knot + " >/dev/null");
    expect_report("info", "info " + film + " >/dev/null");
    run("render " + knot + " -q --size 32x32 --samples 0:2 --film " + path("part.film"));
    run("render " + knot + " -q --size 32x32 --samples 4:6 --film " + path("other.film"));
    expect_report(
        "merge", "merge -q " + path("part.film") + " " + path("other.film") + " -o " + path("whole.film"), 6);
    std::ofstream(path("bad.gltf")) << "{";
    expect_report("info", "info " + path("bad.gltf"), 2);
    expect_lines("render " + path("bad.gltf"), 2);
    const std::string stopped = path("stopped.film");
    run("render " + knot + " -q --size 32x32 --time 0.1 --film " + stopped);
    for (const std::string& of : {film, stopped}) {
        // Its header: after 16 bytes the length, and then as much.
        const std::string bytes = bytes_of(of);
        std::uint64_t length = 0;
        std::memcpy(&length, bytes.data() + 16, sizeof length);
        const std::string header = bytes.substr(24, length);
        EXPECT_EQ(header.find("\"progress\"") != std::string::npos, of == stopped);
        std::ofstream(path("header")) << header;
        expect_schema("film", path("header"));
    }
}

TEST_F(Schemas, describe_comparisons_and_panels) {
    run("render " + knot + " -q --size 32x32 --spp 9 --panel rgb -o " + path("drives.png"));
    run("render " + knot + " -q --size 96x96 --spp 2 -o " + path("large.png"));
    run("render " + knot + small + "-o " + path("a.exr"));
    run("render " + knot + small + "--seed 3 -o " + path("b.exr"));
    expect_report("compare", "compare " + path("a.exr") + " " + path("b.exr") + " >/dev/null");
    expect_report("compare", "compare " + path("a.exr") + " " + path("a.exr") + " --metric psnr >/dev/null");
    expect_report("compare", "compare " + path("drives.png") + " " + path("large.png") +
                                 " --metric perceived --panel rgb >/dev/null");
    expect_report("panel", "panel >/dev/null");
    expect_report("panel", "panel qd-oled --taps >/dev/null");
    expect_report("panel", "panel rgb --taps --filter separable >/dev/null");
    run("panel pentile --write " + path("panel.json") + " >/dev/null");
    expect_schema("panel-file", path("panel.json"));
}

TEST_F(Schemas, describe_devices_and_what_is_kept_of_them) {
    expect_report("devices", "devices >/dev/null");
    expect_report("check", "check --tiny --case L2,M3,C1 >/dev/null");
    expect_report("bench-kernels", "bench kernels --items 1024 --rounds 1 --local 1 --run 2 >/dev/null");
    // Of a cache of its own, where all that is kept is new.
    const std::string own = "XDG_CACHE_HOME=" + path("cache");
    const Outcome tuned = run_triad("tune --json " + path("tune.json") + " >/dev/null", own);
    EXPECT_EQ(tuned.exit, 0) << tuned.output;
    expect_schema("tune", path("tune.json"));
    std::size_t kept = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache/triad"))
        if (entry.path().extension() == ".json") expect_schema("kept", entry.path()), ++kept;
    EXPECT_GE(kept, 2u) << "what was tuned, and which drivers are left out";
}

TEST_F(Schemas, describe_benches) {
    expect_report("bench-error",
                  "bench error --size 16x16 --spp 2 --repetitions 2 --reference-spp 4 --compare "
                  "roulette=0.5,1 -q >/dev/null");
    expect_report("bench-subpixel",
                  "bench subpixel " + knot +
                      " --size 48x48 --rays 9 --repetitions 1 --samples 3 --reference-spp 4 >/dev/null");
    // All features would take minutes: it is interrupted, and ends with the one at hand.
    const Outcome outcome =
        run_triad("bench features --size 8 --spp 1 --repetitions 1 --json " + path("features.json"),
                  "timeout --foreground -s INT 5");
    EXPECT_NE(outcome.output.find("compiled in, not used"), std::string::npos) << outcome.output;
    expect_schema("bench-features", path("features.json"));
}

TEST_F(Schemas, refuse_what_they_do_not_describe) {
    for (const char* wrong : {R"({"phase": "load"})", R"({"phase": "nap", "seconds": 1})",
                              R"({"phase": "load", "seconds": 1, "more": 2})"}) {
        std::ofstream(path("wrong")) << wrong;
        const Outcome outcome =
            run_program("/usr/bin/python3",
                        "-W ignore " TRIAD_SOURCE_DIR "/tests/validate_json.py progress " + path("wrong"));
        if (outcome.exit == 77) GTEST_SKIP() << "python3-jsonschema is not installed";
        EXPECT_EQ(outcome.exit, 1) << wrong << outcome.output;
    }
}
