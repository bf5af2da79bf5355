// A profile adds up: its time line, its shares, what it counts, and what it finds slower.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "json_schema.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

const std::string workload = "profile --size 64x48 --spp 4 --runs 3 -q ";

json json_of(const fs::path& path) { return json::parse(bytes_of(path)); }

Outcome expect_profile(int exit, const std::string& arguments, const std::string& before = "") {
    const Outcome outcome = run_triad(workload + arguments, before);
    EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
    return outcome;
}

struct Interval {
    double start, end;
    std::string name;
};

/// Complete events of each process and thread, by their start.
std::map<std::pair<int, int>, std::vector<Interval>> tracks_of(const json& trace) {
    std::map<std::pair<int, int>, std::vector<Interval>> tracks;
    for (const json& e : trace["traceEvents"]) {
        if (e["ph"] != "X") continue;
        const double start = e["ts"], length = e["dur"];
        EXPECT_GE(start, 0);
        EXPECT_GE(length, 0);
        tracks[{e["pid"], e["tid"]}].push_back({start, start + length, e["name"]});
    }
    for (auto& [key, track] : tracks)
        std::sort(track.begin(), track.end(), [](const Interval& a, const Interval& b) {
            return a.start != b.start ? a.start < b.start : a.end > b.end;
        });
    return tracks;
}

}  // namespace

TEST(ProfileCommand, spans_nest_on_the_host_and_follow_each_other_on_the_queue) {
    const TemporaryFolder folder;
    const fs::path trace = folder / "trace.json";
    expect_profile(0, "--trace " + trace.string());
    constexpr double rounding = 0.01;  // microseconds
    double runs = 0, launches = 0, kernels = 0;
    for (const auto& [track, spans] : tracks_of(json_of(trace))) {
        std::vector<Interval> open;
        for (const Interval& span : spans) {
            while (!open.empty() && open.back().end <= span.start + rounding) open.pop_back();
            if (track.first == 2) {
                EXPECT_TRUE(open.empty()) << span.name << " overlaps another";
            }
            if (!open.empty()) {
                EXPECT_LE(span.end, open.back().end + rounding) << span.name;
            }
            if (open.empty() && span.name == "launch") ADD_FAILURE() << "a launch outside of a render";
            open.push_back(span);
            if (span.name == "render") runs += span.end - span.start;
            if (span.name == "launch") launches += span.end - span.start;
            if (span.name == "trace_paths" || span.name == "trace_wave") kernels += span.end - span.start;
        }
    }
    EXPECT_GT(runs, 0);
    EXPECT_GT(launches, 0.5 * runs);
    EXPECT_LE(launches, runs);
    EXPECT_GT(kernels, 0);
    EXPECT_LE(kernels, launches);
}

TEST(ProfileCommand, every_driver_of_paths_counts_the_same_rays_and_its_shares_add_up) {
    const TemporaryFolder folder;
    std::vector<json> rays;
    for (const std::string driver : {"mega", "wave", "wave-stages"}) {
        const fs::path path = folder / "a.json";
        expect_profile(0, "--driver " + driver + " --json " + path.string());
        expect_schema("profile", path);
        const json report = json_of(path);
        EXPECT_EQ(report["schema"], "triad.profile/1");
        double share = 0;
        for (const json& row : report["rows"]) {
            share += double(row["share"]);
            EXPECT_EQ(row["ms_of_runs"].size(), 3u);
            EXPECT_LE(double(row["ms_median"]), double(row["ms_p95"]));
            if (!row["roofline_share"].is_null()) {
                EXPECT_LE(double(row["roofline_share"]), 1.0) << row;
            }
        }
        EXPECT_NEAR(share, 1, 1e-6);
        const json& device = report["devices"][0];
        EXPECT_EQ(device["path_driver"], driver);
        const json& queue = device["queue"];
        EXPECT_GT(double(queue["busy_s"]), 0);
        EXPECT_LE(double(queue["host_s"]), double(queue["waiting_s"]));
        rays.push_back(device["rays"]);
        double on_edges = 0, to_lights = 0;
        for (const json& edge : device["edges"]) {
            on_edges += double(edge["rays_per_sample"]), to_lights += double(edge["shadow_rays_per_sample"]);
            EXPECT_LE(double(edge["hits_per_sample"]), double(edge["rays_per_sample"]));
            EXPECT_LE(double(edge["shadow_rays_per_sample"]), double(edge["hits_per_sample"]));
        }
        const json& r = device["rays"];
        EXPECT_NEAR(on_edges * 64 * 48 * 4, double(r["camera"]["rays"]) + double(r["bounce"]["rays"]), 1);
        EXPECT_NEAR(to_lights * 64 * 48 * 4, double(r["shadow"]["rays"]), 1);
        EXPECT_EQ(double(device["edges"][0]["rays_per_sample"]), 1);
    }
    EXPECT_EQ(rays[0], rays[1]);
    EXPECT_EQ(rays[0], rays[2]);
    // What the instrumented program traces is what the picture traces.
    const fs::path film = folder / "a.film", render = folder / "render.json";
    ASSERT_EQ(
        run_triad("render --size 64x48 --spp 4 -q --film " + film.string() + " --json " + render.string())
            .exit,
        0);
    std::uint64_t counted = 0;
    for (const json& kind : rays[0]) counted += std::uint64_t(kind["rays"]);
    EXPECT_EQ(counted, std::uint64_t(json_of(render)["rows"][0]["rays"]));
    EXPECT_EQ(rays[0]["camera"]["rays"], 64 * 48 * 4);
}

TEST(ProfileCommand, another_format_of_nodes_takes_other_visits_for_the_same_rays) {
    const TemporaryFolder folder;
    const fs::path eight = folder / "8.json", four = folder / "4.json";
    expect_profile(0, "--format bvh8 --json " + eight.string());
    expect_profile(0, "--format bvh4 --json " + four.string());
    const json a = json_of(eight)["devices"][0], b = json_of(four)["devices"][0];
    EXPECT_EQ(a["rays"]["shadow"]["rays"], b["rays"]["shadow"]["rays"]);
    EXPECT_GT(double(b["rays"]["camera"]["nodes_per_ray"]), double(a["rays"]["camera"]["nodes_per_ray"]));
}

TEST(ProfileCommand, what_became_slower_ends_with_7_and_other_work_is_not_compared) {
    const TemporaryFolder folder;
    const fs::path now = folder / "now.json", faster = folder / "faster.json";
    expect_profile(0, "--json " + now.string());
    json earlier = json_of(now);
    for (json& row : earlier["rows"])
        for (json& ms : row["ms_of_runs"]) ms = 0.2 * double(ms);
    std::ofstream(faster) << earlier;
    const Outcome outcome = expect_profile(7, "--against " + faster.string());
    EXPECT_NE(outcome.output.find("slower"), std::string::npos) << outcome.output;
    for (json& row : earlier["rows"])
        for (json& ms : row["ms_of_runs"]) ms = 100 * double(ms);
    std::ofstream(faster) << earlier;
    expect_profile(0, "--against " + faster.string());
    EXPECT_NE(run_triad("profile --size 64x48 --spp 8 --runs 2 -q --against " + now.string())
                  .output.find("other work"),
              std::string::npos);
    expect_profile(2, "--against '" TRIAD_SCENES "/suite/glass.glb'");
    expect_profile(1, "--time 1");
    expect_profile(1, "--device all");
}

TEST(ProfileCommand, what_cannot_be_compared_is_found_before_anything_is_measured) {
    const TemporaryFolder folder;
    const fs::path now = folder / "now.json", other = folder / "other.json", trace = folder / "trace.json";
    expect_profile(0, "--json " + now.string());
    const auto refused = [&](int exit, const json& report, const std::string& sentence, int runs = 3) {
        std::ofstream(other) << report;
        const Outcome outcome = run_triad("profile --size 64x48 --spp 4 -q --runs " + std::to_string(runs) +
                                          " --trace " + trace.string() + " --against " + other.string());
        EXPECT_EQ(outcome.exit, exit) << outcome.output;
        EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
        EXPECT_FALSE(fs::exists(trace));
    };
    const json report = json_of(now);
    json changed = report;
    changed["schema"] = 1;
    refused(2, changed, "no --json of this command");
    for (const char* rows : {"7", "[7]", R"([{"kernel": 7}])", R"([{"ms_of_runs": ["a"]}])"}) {
        changed = report, changed["rows"] = json::parse(rows);
        refused(2, changed, "no --json of this command");
    }
    changed = report, changed["workload"]["spp"] = 5;
    refused(1, changed, "other work");
    changed = report;
    for (json& row : changed["rows"]) row["device"] = "another";
    refused(1, changed, "no kernel of this device");
    refused(1, report, "need two or more", 1);
}

TEST(ProfileCommand, the_page_needs_nothing_from_outside) {
    const TemporaryFolder folder;
    expect_profile(0, "-o " + (folder / "page").string());
    const std::string page = bytes_of(folder / "page/index.html");
    for (const char* part :
         {"trace_", "camera", "data:image/png", "data:image/svg+xml", "GFLOP/s", "</html>"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    for (const char* outside : {"src=\"http", "href=\"http", "url(http", "<script"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}
