// The scores of the subpixel bench: tiles, intervals, pairs, and what stands in the files.
#include "bench/subpixel_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "report/subpixel_report.h"

using namespace triad;

namespace {

/// A map of one difference in lightness everywhere, of 32 x 32 px at 3 samples, with noise.
PerceivedError noisy(double lightness, double noise, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0, float(noise));
    PerceivedError error;
    error.map = {96, 96, std::vector<float>(96 * 96 * 3)};
    for (std::size_t i = 0; i < error.map.rgb.size(); i += 3)
        error.map.rgb[i] = float(lightness) + normal(random);
    return error;
}

SubpixelPlan plan() { return {{PanelView{builtin_panel("rgb").value(), 45}}}; }

bool has(const std::vector<SubpixelMethod>& methods, const std::string& name) {
    return std::any_of(methods.begin(), methods.end(),
                       [&](const SubpixelMethod& m) { return m.name == name; });
}

}  // namespace

TEST(SubpixelScore, a_constant_error_is_its_value_without_doubt) {
    const TileErrors tiles = tile_errors(noisy(2, 0, 1), 3, 8);
    EXPECT_EQ(tiles.samples.size(), 4u);  // 16 px within the border
    const ErrorInterval e = error_interval(tiles);
    EXPECT_NEAR(e.value, 2, 1e-6);
    EXPECT_NEAR(e.low, 2, 1e-6);
    EXPECT_NEAR(e.high, 2, 1e-6);
    EXPECT_NEAR(root_mean(tiles.colour, tiles.samples), 0, 1e-9);
}

TEST(SubpixelScore, pairs_see_a_difference_that_single_intervals_hide) {
    // Tiles differ much among themselves, but b is a little worse in each.
    TileErrors a, b;
    for (int i = 0; i < 40; ++i) {
        a.lightness.push_back(1 + i), b.lightness.push_back(1.02 * (1 + i));
        for (TileErrors* t : {&a, &b}) t->colour.push_back(0), t->samples.push_back(1);
    }
    EXPECT_GT(error_interval(a).high, error_interval(b).low);
    EXPECT_LT(difference_interval(a, b).high, 0);
    EXPECT_GT(difference_interval(b, a).low, 0);
    EXPECT_EQ(difference_interval(a, a).high, 0);
}

TEST(SubpixelScore, repetitions_add_up_to_their_mean_square) {
    TileErrors sum;
    add(sum, tile_errors(noisy(3, 0, 1), 3, 8));
    add(sum, tile_errors(noisy(4, 0, 1), 3, 8));
    EXPECT_NEAR(error_interval(sum).value, std::sqrt(12.5), 1e-6);
    TileErrors other;
    other.samples = {1};
    EXPECT_THROW(add(sum, other), std::invalid_argument);
}

TEST(SubpixelBench, every_method_takes_part_once) {
    const auto methods = subpixel_display(plan().displays[0]).methods;
    for (const char* name :
         {"centre", "pane:4", "pane-encoded:4", "box", "tent", "gaussian", "mitchell", "catmull-rom",
          "lanczos", "blackman-harris", "subpixel3", "displaced", "platt", "platt:3", "random3",
          "random3:shared", "triad-unrefined", "triad", "triad-adaptive"})
        EXPECT_TRUE(has(methods, name)) << name;
    EXPECT_EQ(methods.size(), 19u);
    const auto oled = subpixel_display({builtin_panel("qd-oled").value(), 45}).methods;
    EXPECT_FALSE(has(oled, "platt"));  // no stripes
    EXPECT_TRUE(has(oled, "triad") && has(oled, "triad-adaptive"));
    EXPECT_EQ(supersampling(5).how.bins_x, 5u);
}

TEST(SubpixelBench, files_hold_every_row_and_the_verdict) {
    SubpixelReport report{plan(), {}, "triad bench subpixel", ""};
    report.plan.rays = {9};
    report.rows.push_back(
        {"a, \"b\"", "rgb", 45, "scielab", "triad", 9, 9, {1, 0.9, 1.1}, 0.8, 0.6, 0.5, {}});
    report.rows.push_back({"a, \"b\"",
                           "rgb",
                           45,
                           "scielab",
                           "box",
                           9,
                           9,
                           {2, 1.9, 2.1},
                           1,
                           1,
                           0.5,
                           ErrorInterval{-1, -1.1, -0.9}});
    const Json rows = rows_of(report);
    ASSERT_EQ(rows.size(), 2u);
    for (const char* member : {"scene", "panel", "ppd", "eye", "method", "rays_per_pixel", "error",
                               "error_low", "error_high", "seconds"})
        EXPECT_TRUE(rows[0].contains(member)) << member;
    const std::string csv = csv_of(report);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_NE(csv.find("\"a, \"\"b\"\"\""), std::string::npos);
    EXPECT_NE(summary_of(report).find("of 1 comparisons at equal rays 1 are"), std::string::npos);
    report.rows[1].over_triad = ErrorInterval{1, 0.9, 1.1};
    EXPECT_NE(summary_of(report).find(
                  "of 1 comparisons at equal rays 0 are significantly better than triad, 1 worse"),
              std::string::npos);
}
