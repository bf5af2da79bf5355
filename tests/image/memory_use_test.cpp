// How much memory commands take, and what they say where that would be too much.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "expect_exit.h"
#include "io/io.h"
#include "program.h"
#include "running.h"
#include "unit/gltf_builder.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;
using nlohmann::json;

namespace {

/// Bytes that the program took at most.
std::int64_t most_memory(const std::string& arguments, const std::string& before = "") {
    Running program(arguments, before);
    std::int64_t most = 0;
    EXPECT_EQ(program.wait(most), 0);
    return most;
}

}  // namespace

TEST(MemoryUse, films_are_merged_in_memory_for_a_few_rows) {
    const TemporaryFolder folder;
    const std::string render = "render --size 1024x1024 --bins 2x2 --film " + (folder / "").string();
    expect_exit(0, render + "a --samples 0:4");
    expect_exit(0, render + "b --samples 4:8");
    ASSERT_GT(fs::file_size(folder / "a"), 150u << 20);
    const std::string before = "cd '" + (folder / "").string() + "';";
    EXPECT_LT(most_memory("merge a b -o m -q", before) - most_memory("--version"), 32 << 20);
    EXPECT_EQ(load_film(folder / "m").samples[0], 8u);
}

TEST(MemoryUse, many_nodes_take_little_more_memory_than_what_is_kept_of_them) {
    const TemporaryFolder folder;
    GltfBuilder b;
    b.triangle();
    const auto rendered = [&](std::size_t count, double& kept) {
        json nodes = json::array(), roots = json::array();
        for (std::size_t i = 0; i < count; ++i) {
            nodes.push_back({{"mesh", 0}, {"translation", {2 * (i % 1000), 2 * (i / 1000), 0}}});
            roots.push_back(i);
        }
        b.document["nodes"] = std::move(nodes);
        b.document["scenes"][0]["nodes"] = std::move(roots);
        b.load();
        const std::string report = (folder / "report.json").string();
        const std::int64_t most =
            most_memory("render '" + (b.folder / "scene.gltf").string() +
                        "' --size 32x32 --spp 1 -q --json " + report + " -o " + (folder / "a.png").string());
        const json row = json::parse(bytes_of(report))["rows"][0];
        kept = row["scene_bytes"].get<double>() + row["device_bytes"].get<double>();
        return double(most);
    };
    double few_kept = 0, many_kept = 0;
    rendered(1, few_kept), rendered(400'000, many_kept);  // compile
    const double few = rendered(1, few_kept), many = rendered(400'000, many_kept);
    EXPECT_GT(many_kept - few_kept, 100e6);
    EXPECT_GT(few, 1e7);
    EXPECT_LT((many - few) / (many_kept - few_kept), 1.5) << many << " and " << few;
}

TEST(MemoryUse, what_is_too_large_for_the_memory_is_said_before_it_is_taken) {
    const Outcome film =
        run_triad("render --max-memory 200M --size 3000x3000 --spp 1 -o /tmp/triad-none.png");
    EXPECT_EQ(film.exit, 4) << film.output;
    EXPECT_NE(film.output.find("The film of 9000000 pixels needs"), std::string::npos) << film.output;
    EXPECT_EQ(run_triad("render --max-memory 2G --size 30x30 --spp 1 -q -o /tmp/triad-none.png").exit, 0);
    fs::remove("/tmp/triad-none.png");
}
