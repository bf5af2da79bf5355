// What triad-replay decides without a device: whether films agree, what rows say, which files programs had.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "capture/capture.h"
#include "device/device.h"
#include "kernels/types.h"
#include "profile/profile.h"
#include "profile/profile_report.h"
#include "profile/work_json.h"
#include "replay/include_tree.h"
#include "replay/verify.h"
#include "sentence_of.h"

namespace triad {
namespace {

constexpr std::uint64_t side = 64;

template <class T>
AlignedVector<std::byte> as_bytes(const std::vector<T>& values) {
    AlignedVector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// A film of 64 x 64 pixels with four samples each, as a device holds it.
struct FlatFilm {
    std::vector<std::int64_t> sums = std::vector<std::int64_t>(side * side * FILM_CHANNELS, 1 << 20);
    std::vector<std::uint32_t> samples = std::vector<std::uint32_t>(side * side, 4);
    std::vector<std::uint32_t> counters = std::vector<std::uint32_t>(2 * COUNTERS, 0);

    FlatFilm() { counters[2 * COUNTER_RAYS] = 100000; }

    /// Changes the colours of a pixel by this factor.
    void scale(std::uint64_t x, std::uint64_t y, double factor) {
        for (std::uint64_t c = 0; c < 3; ++c) {
            std::int64_t& sum = sums[(y * side + x) * FILM_CHANNELS + c];
            sum = std::int64_t(double(sum) * factor);
        }
    }
    ReplayedFilm arrays() const {
        return {as_bytes(sums), as_bytes(std::vector<std::int64_t>(side * side * 3)), as_bytes(samples),
                as_bytes(counters)};
    }
};

Capture captured() {
    Capture capture;
    capture.width = capture.height = side, capture.bins = 1;
    const ReplayedFilm arrays = FlatFilm().arrays();
    for (std::size_t i = 0; i < arrays.size(); ++i)
        capture.film.push_back({CapturedArray::What(i), i, 0, side * side,
                                std::make_shared<const AlignedVector<std::byte>>(arrays[i])});
    return capture;
}

/// Why such a film does not agree; empty: it does.
std::string why_not(const FlatFilm& film) { return difference(captured(), film.arrays()).why_not(); }

TEST(ReplayVerify, equal_films_have_the_same_bits) {
    const FilmDifference same = difference(captured(), FlatFilm().arrays());
    EXPECT_TRUE(same.same_bits);
    EXPECT_EQ(same.bins_off, 0u);
    EXPECT_EQ(same.tiles, 64u);
    EXPECT_EQ(same.samples_per_bin, 4);
    EXPECT_EQ(same.why_not(), "");
}

TEST(ReplayVerify, a_few_paths_astray_agree_and_many_do_not) {
    FlatFilm few, many;
    for (std::uint64_t i = 0; i < 24; ++i) few.scale(i * 7 % side, i, i % 2 ? 1.5 : 0.5);
    EXPECT_FALSE(difference(captured(), few.arrays()).same_bits);
    EXPECT_EQ(why_not(few), "");
    for (std::uint64_t y = 0; y < side; ++y)
        for (std::uint64_t x = y % 8; x < side; x += 8) many.scale(x, y, x % 16 < 8 ? 1.01 : 0.99);
    EXPECT_NE(why_not(many).find("of the bins"), std::string::npos) << why_not(many);
}

TEST(ReplayVerify, a_dark_corner_does_not_agree) {
    FlatFilm film;
    for (std::uint64_t y = 0; y < 24; ++y)
        for (std::uint64_t x = 0; x < 24; ++x) film.scale(x, y, 0);
    EXPECT_NE(why_not(film).find("of the tiles"), std::string::npos) << why_not(film);
}

TEST(ReplayVerify, what_is_small_but_everywhere_does_not_agree) {
    FlatFilm film;
    for (std::uint64_t y = 0; y < side; ++y)
        for (std::uint64_t x = 0; x < side; ++x) film.scale(x, y, 0.9992);
    EXPECT_NE(why_not(film).find("darker in the median"), std::string::npos) << why_not(film);
}

TEST(ReplayVerify, lost_samples_and_other_numbers_of_rays_do_not_agree) {
    FlatFilm lost, rays;
    lost.samples[5] = 3;
    EXPECT_NE(why_not(lost).find("numbers of samples"), std::string::npos) << why_not(lost);
    rays.counters[2 * COUNTER_RAYS] = 103000;
    EXPECT_NE(why_not(rays).find("number of rays"), std::string::npos) << why_not(rays);
}

/// A launch or a transfer of so many milliseconds, from `start` on.
DeviceCommand command(const char* name, double start, double ms, std::size_t items) {
    DeviceCommand c;
    c.kind = items > 0 ? CommandKind::kernel : CommandKind::write;
    c.name = name, c.items = items;
    c.queued = c.start = std::int64_t(1e6 * start), c.end = std::int64_t(1e6 * (start + ms));
    return c;
}

TEST(ProfileRows, have_medians_shares_rates_and_what_the_queue_waited) {
    Profile p;
    add_commands(p,
                 {{command("a", 0, 1, 500), command("a", 1, 3, 500), command("b", 5, 4, 10)},
                  {command("a", 0, 2, 500), command("a", 2, 2, 500), command("b", 7, 8, 10)}},
                 {});
    ASSERT_EQ(p.rows.size(), 2u);
    EXPECT_EQ(p.runs, 2u);
    EXPECT_EQ(p.rows[0].kernel, "b");  // the longest first
    EXPECT_NEAR(p.rows[0].ms_median, 6, 1e-9);
    EXPECT_NEAR(p.rows[0].ms_p95, 8, 1e-9);
    EXPECT_EQ(p.rows[1].launches, 4u);
    EXPECT_NEAR(p.rows[1].ms_median, 2, 1e-9);
    EXPECT_NEAR(p.rows[1].ms.value, 4, 1e-9);
    EXPECT_NEAR(p.rows[1].share, 0.4, 1e-9);
    EXPECT_NEAR(p.rows[1].items_per_s, 250000, 1e-6);
    EXPECT_NEAR(p.busy, 0.012, 1e-12);
    EXPECT_NEAR(p.waiting, 0.003, 1e-12);
}

TEST(ProfileRows, know_how_many_items_had_work) {
    Profile p;
    p.format = "bvh8", p.samples = 100;
    add_commands(p, {{command("wave_intersect_edges", 0, 1, 1000)}}, {});
    WorkCounts counts;
    counts.width = 10, counts.height = 10, counts.samples = 1;
    counts.rays[WORK_CAMERA].rays = 100, counts.rays[WORK_BOUNCE].rays = 150;
    counts.edges[0] = {100, 80, 60}, counts.edges[1] = {150, 0, 0};
    add_costs(p, counts, {.flops = 1e9, .memory = {{1 << 18, 1e9, 1e9, 1e8}}, .seconds = 0});
    EXPECT_NEAR(p.rows[0].units_per_item(p.runs), 0.25, 1e-12);
    const std::vector<EdgeLine> lines = edge_lines(counts);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_NEAR(lines[0].hits, 0.8, 1e-12);
    EXPECT_NEAR(lines[1].rays, 1.5, 1e-12);
}

TEST(WorkJson, comes_back_as_it_was_and_damage_is_told) {
    WorkCounts counts;
    counts.width = 3, counts.height = 2, counts.samples = 4;
    counts.rays[WORK_SHADOW] = {1ull << 40, 2, 3, 4, 5, 6};
    counts.edges[WORK_EDGES - 1] = {7, 8, 9};
    const std::string text = text_of(counts);
    EXPECT_EQ(text_of(work_counts_of(text)), text);
    EXPECT_EQ(work_counts_of(text).rays[WORK_SHADOW].deepest, 6u);
    for (std::size_t i = 0; i < text.size(); ++i)
        sentence_of(Exit::scene, [&] { work_counts_of(text.substr(0, i)); });
    for (const char* other : {"{}", "[]", "3", "null", "{\"width\": \"x\"}"})
        sentence_of(Exit::scene, [&] { work_counts_of(other); });
}

TEST(IncludeTree, is_what_programs_were_flattened_from) {
    std::vector<Recording::Source> sources;
    for (const char* path : {"path/mega.cl", "photon/map.cl"})
        sources.push_back({path, kernel_source::load(path), {}});
    const std::map<std::string, std::string> tree = include_tree(sources);
    EXPECT_EQ(tree.at("common/film.h"), kernel_source::text("common/film.h"));
    EXPECT_EQ(tree.at("path/mega.cl"), kernel_source::text("path/mega.cl"));
    EXPECT_GT(tree.size(), 20u);
}

TEST(IncludeTree, leaves_its_folder_for_no_program) {
    for (const char* path : {"../outside.h", "a/../../outside.h", "/outside.h"}) {
        const std::string text = std::string("#line 1 \"kernels/") + path + "\"\nint x;\n";
        sentence_of(Exit::scene, [&] { include_tree({{"a.cl", text, {}}}); });
    }
    sentence_of(Exit::scene, [] {
        include_tree({{"a.cl", "#line 1 \"kernels/a.cl\"\nx\n#line 99999999999 \"kernels/a.cl\"\ny\n", {}}});
    });
}

}  // namespace
}  // namespace triad
