// The chart by which a person sees their panel: on every panel its own tile is the least coloured.
#include "report/panel_chart.h"

#include <gtest/gtest.h>

#include "panel/perceived.h"

using namespace triad;

TEST(PanelChart, has_the_fewest_fringes_in_the_tile_of_the_panel_that_shows_it) {
    const char* const names[] = {"off", "rgb", "bgr", "vrgb", "vbgr", "qd-oled", "qd-oled@180", "pentile"};
    std::vector<RgbImage> tiles;
    for (const char* name : names) tiles.push_back(chart_tile(builtin_panel(name).value(), 45));
    const RgbImage lines = chart_lines(6);
    for (std::size_t own = 1; own < std::size(names); ++own) {
        const PerceivedMetric metric(builtin_panel(names[own]).value(), lines, 6, {.ppd = 45});
        const double colour = metric.of(tiles[own]).colour;
        for (std::size_t other = 0; other < std::size(names); ++other) {
            if (other == own) continue;
            EXPECT_GT(metric.of(tiles[other]).colour, 1.3 * colour)
                << "of " << names[other] << " on " << names[own] << ", which has " << colour;
        }
    }
}

TEST(PanelChart, names_its_tiles_and_starts_them_on_whole_cells) {
    const BytePicture chart = panel_chart(45);
    EXPECT_EQ(chart.width % 2, 0u);
    EXPECT_GE(chart.width, 3 * chart_tile_width);
    std::size_t black = 0;
    for (std::size_t i = 0; i < chart.rgb.size(); i += 3)
        black += chart.rgb[i] == 0 && chart.rgb[i + 1] == 0 && chart.rgb[i + 2] == 0;
    EXPECT_GT(black, 1000u) << "of letters";
}

TEST(SmallType, draws_letters_where_they_are_wanted_and_nothing_outside) {
    BytePicture picture(8, 6, {255, 255, 255});
    draw_type(picture, "1", 1, 1, 1, {0, 0, 0});
    const auto at = [&](unsigned x, unsigned y) { return picture.rgb[(y * picture.width + x) * 3]; };
    EXPECT_EQ(at(2, 1), 0);
    EXPECT_EQ(at(1, 1), 255);
    EXPECT_EQ(at(1, 5), 0);
    EXPECT_EQ(at(3, 5), 0);
    EXPECT_EQ(type_width("12", 2), 14u);
    EXPECT_NO_THROW(draw_type(picture, "ABC", 6, 3, 3, {0, 0, 0}));
}
