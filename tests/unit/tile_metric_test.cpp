// Errors by tile of three eyes at once are those of the metric, one eye after the other.
#include "panel/tile_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"

using namespace triad;

namespace {

RgbImage random_image(unsigned width, unsigned height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any;
    RgbImage image{width, height, std::vector<float>(std::size_t(width) * height * 3)};
    for (float& v : image.rgb) v = any(random);
    return image;
}

/// Edges and a slope, at 6 samples per pixel.
RgbImage picture(unsigned width, unsigned height) {
    RgbImage image{width * 6, height * 6, {}};
    for (unsigned y = 0; y < image.height; ++y)
        for (unsigned x = 0; x < image.width; ++x) {
            const bool light = (x + y / 3) / 37 % 2;
            for (unsigned c = 0; c < 3; ++c)
                image.rgb.push_back(light ? 1.0f - 0.2f * float(c) : float(x) / float(image.width));
        }
    return image;
}

}  // namespace

TEST(TileMetric, agrees_with_the_metric_on_every_panel_and_eye) {
    const RgbImage reference = picture(48, 40);
    const RgbImage drives = random_image(48, 40, 7);
    for (const char* name : {"rgb", "vbgr", "qd-oled@90", "pentile", "woled", "off"})
        for (const double ppd : {30.0, 60.0, 110.0}) {
            const Panel panel = builtin_panel(name).value();
            const TileMetric metric(panel, ppd, reference, 6);
            const auto tiles = metric.of(drives);
            for (std::size_t e = 0; e < all_eyes.size(); ++e) {
                const PerceivedError wanted =
                    PerceivedMetric(panel, reference, 6, {.ppd = ppd, .eye = all_eyes[e]}).of(drives);
                EXPECT_NEAR(error_interval(tiles[e]).value, wanted.error, 0.005 * wanted.error)
                    << name << " " << ppd << " " << eye_name(all_eyes[e]);
                EXPECT_NEAR(root_mean(tiles[e].colour, tiles[e].samples), wanted.colour, 0.01 * wanted.error);
                const TileErrors whole = tile_errors(wanted, 6, perceived_border(ppd));
                ASSERT_EQ(whole.samples.size(), tiles[e].samples.size());
                for (std::size_t t = 0; t < whole.samples.size(); ++t)
                    EXPECT_NEAR(std::sqrt(tiles[e].lightness[t] / tiles[e].samples[t]),
                                std::sqrt(whole.lightness[t] / whole.samples[t]), 0.05 * wanted.error);
            }
        }
}

TEST(TileMetric, has_no_more_samples_than_eyes_can_tell_apart) {
    const RgbImage reference = picture(36, 36);
    const Panel panel = builtin_panel("rgb").value();
    EXPECT_EQ(TileMetric(panel, 110, reference, 6).map_samples(), 2u);
    EXPECT_EQ(TileMetric(panel, 5, reference, 6).map_samples(), 6u);
}

TEST(TileMetric, refuses_pictures_that_cells_do_not_fill) {
    EXPECT_THROW(TileMetric(builtin_panel("pentile").value(), 45, picture(33, 32), 6), Error);
    EXPECT_THROW(TileMetric(builtin_panel("rgb").value(), 110, picture(36, 34), 6), Error);
}
