// triad bench device: what it measures is all there and right, and boards join.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "json_schema.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using nlohmann::json;

TEST(BenchDeviceCommand, measures_every_part_and_boards_join) {
    const TemporaryFolder folder;
    const fs::path board = folder / "board";
    const Outcome outcome = run_triad("bench device --quick --time 240 --progress json -o " + board.string());
    ASSERT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("\"seconds_left\""), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("\"doing\": \""), std::string::npos);
    expect_schema("bench-device", board / "board.json");
    const json report = json::parse(bytes_of(board / "board.json"));
    EXPECT_EQ(report["schema"], "triad.bench-device/1");
    ASSERT_EQ(report["boards"].size(), 1u);
    EXPECT_EQ(report["boards"][0]["device"], report["device"]["name"]);
    EXPECT_TRUE(report["boards"][0]["right"]);
    std::set<std::string> parts, formats, drivers, scenes, kernels;
    for (const json& row : report["rows"]) {
        parts.insert(row["part"]);
        EXPECT_TRUE(row["right"]) << row;
        EXPECT_EQ(row["board"], 0);
        if (row["part"] == "rays") formats.insert(row["format"]);
        if (row["part"] == "paths") drivers.insert(row["path_driver"]);
        if (row["part"] == "stage") kernels.insert(row["name"]);
        if (row["part"] != "efficiency") continue;
        EXPECT_GE(double(row["spp"]), 64) << row;  // enough to be compared with the references
        scenes.insert(row["name"]);
    }
    EXPECT_EQ(parts, (std::set<std::string>{"check", "peak", "rays", "paths", "stage", "display", "error",
                                            "efficiency"}));
    EXPECT_EQ(formats, (std::set<std::string>{"bvh4", "bvh8", "bvh8 packets"}));
    EXPECT_EQ(scenes.size(), 10u);
    EXPECT_TRUE(drivers.contains("mega") && drivers.contains("wave-stages"));
    for (const char* kernel : {"trace_paths", "wave_intersect_edges", "wave_scatter_paths"})
        EXPECT_TRUE(kernels.contains(kernel)) << kernel;

    const std::string file = (board / "board.json").string(), both = (folder / "both").string();
    ASSERT_EQ(run_triad("bench device --against " + file + " " + file + " -q -o " + both).exit, 0);
    const json joined = json::parse(bytes_of(fs::path(both) / "board.json"));
    EXPECT_EQ(joined["boards"].size(), 2u);
    EXPECT_EQ(joined["rows"].size(), 2 * report["rows"].size());
    EXPECT_NE(bytes_of(fs::path(both) / "index.html").find("(x1)"), std::string::npos);
    // What was joined joins again.
    const Outcome again = run_triad("bench device --against " + both + "/board.json " + file);
    EXPECT_EQ(again.exit, 0);
    EXPECT_NE(again.output.find("C: "), std::string::npos) << again.output;
}

TEST(BenchDeviceCommand, has_no_time_and_says_what_it_left_out) {
    const TemporaryFolder folder;
    const fs::path path = folder / "a.json";
    const Outcome outcome = run_triad("bench device --quick --time 1 --json " + path.string());
    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("There was no time for: "), std::string::npos) << outcome.output;
    EXPECT_EQ(json::parse(bytes_of(path))["boards"][0]["left_out"].size(), 2u);
}

TEST(BenchDeviceCommand, refuses_what_it_cannot_do) {
    const TemporaryFolder folder;
    const fs::path bad = folder / "bad.json";
    std::ofstream(bad) << "{\"schema\": \"triad.profile/1\"}";
    const std::string against = "bench device --against " + bad.string();
    const Outcome outcome = run_triad(against);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.output.find("is no report of triad bench device"), std::string::npos) << outcome.output;
    EXPECT_EQ(run_triad("bench device --against " + (folder / "none.json").string()).exit, 2);
    for (const std::string& more : {std::string(" --quick"), std::string(" --device 0"),
                                    std::string(" --time 5"), " --json " + bad.string()})
        EXPECT_EQ(run_triad(against + more).exit, 1) << more;
    for (const std::string option : {"--time 0", "--device no-such-device", "--progress loud"})
        EXPECT_EQ(run_triad("bench device " + option).exit, 1) << option;
}
