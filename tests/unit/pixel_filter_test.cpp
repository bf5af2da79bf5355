// Pixel filters as taps: their sums, their places, their shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/error.h"
#include "panel/pixel_filter.h"

using namespace triad;

namespace {

double sum_of_weights(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST(PixelFilter, weights_sum_to_one_for_every_shape_width_and_resolution) {
    for (const std::string& name : filter_names())
        for (const char* width : {"", ":0.3", ":1.7", ":5", ":16"})
            for (const unsigned bins : {1u, 2u, 3u, 7u, 16u}) {
                const TapTable table = filter_taps(parse_filter(name + width), bins, bins);
                ASSERT_EQ(table.outputs.size(), 3u);
                const Taps& taps = table.outputs[1];
                EXPECT_NEAR(sum_of_weights(taps.weights), 1.0, 6e-8) << name << width << " " << bins;
                EXPECT_NEAR(sum_of_weights(taps.across), 1.0, 6e-8) << name << width << " " << bins;
                EXPECT_NEAR(sum_of_weights(taps.down), 1.0, 6e-8) << name << width << " " << bins;
                for (unsigned v = 0; v < taps.height; ++v)
                    for (unsigned u = 0; u < taps.width; ++u)
                        EXPECT_NEAR(taps.weights[v * taps.width + u], taps.down[v] * taps.across[u], 1e-6);
                for (unsigned u = 0; u < taps.width; ++u)
                    EXPECT_NEAR(taps.across[u], taps.across[taps.width - 1 - u], 2e-7) << "not symmetric";
            }
}

TEST(PixelFilter, taps_are_those_of_the_textbook) {
    const Taps box = filter_taps({}, 3, 3).outputs[0];
    EXPECT_EQ(box.first_x, 0);
    EXPECT_EQ(box.across.size(), 3u);
    EXPECT_NEAR(box.across[0], 1 / 3.0, 1e-7);
    // The tent over whole pixels: 1/8, 3/4, 1/8.
    const Taps tent = filter_taps(parse_filter("tent"), 1, 1).outputs[0];
    EXPECT_EQ(tent.first_x, -1);
    ASSERT_EQ(tent.across.size(), 3u);
    EXPECT_NEAR(tent.across[0], 0.125, 1e-7);
    EXPECT_NEAR(tent.across[1], 0.75, 1e-7);
    EXPECT_NEAR(filter_value(parse_filter("mitchell"), 0.0), 16 / 18.0, 1e-12);
    EXPECT_NEAR(filter_value(parse_filter("mitchell"), 1.0), 1 / 18.0, 1e-12);
    EXPECT_NEAR(filter_value(parse_filter("catmull-rom"), 1.0), 0.0, 1e-12);
    EXPECT_NEAR(filter_value(parse_filter("catmull-rom"), 0.5), 0.5625, 1e-12);
    EXPECT_NEAR(filter_value(parse_filter("lanczos"), 1.0), 0.0, 1e-12);
    EXPECT_NEAR(filter_value(parse_filter("gaussian"), 0.5), std::exp(-0.5) - std::exp(-4.5), 1e-12);
    EXPECT_NEAR(filter_value(parse_filter("blackman-harris"), 1.4999999), 6e-5, 1e-6);
}

TEST(PixelFilter, names_and_widths_that_are_none_are_refused) {
    for (const char* text : {"", "sinc", "box:", "box:0", "box:-1", "box:17", "box:nan", "box:1x", "box:1:2"})
        EXPECT_THROW(parse_filter(text), Error) << text;
    EXPECT_EQ(parse_filter("box:2.5").width, 2.5);
    EXPECT_EQ(parse_filter("lanczos").width, 6.0);
}
