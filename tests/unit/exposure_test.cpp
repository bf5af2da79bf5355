// --exposure auto.
#include "display/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "synthetic_film.h"

using namespace triad;

namespace {

std::vector<float> grey(std::size_t pixels, float value, float alpha = 1) {
    std::vector<float> rgba;
    for (std::size_t i = 0; i < pixels; ++i) rgba.insert(rgba.end(), {value, value, value, alpha});
    return rgba;
}

}  // namespace

TEST(AutomaticExposure, makes_an_even_picture_mid_grey) {
    for (float value : {0.18f, 0.36f, 9.0f, 1e-4f})
        EXPECT_NEAR(automatic_exposure(grey(64 * 40, value), 64), std::log2(0.18 / value), 0.051) << value;
}

TEST(AutomaticExposure, is_in_tenths_and_changes_with_light_alone) {
    const double ev = automatic_exposure(grey(100, 0.7f), 10);
    EXPECT_NEAR(10 * ev, std::round(10 * ev), 1e-9);
    EXPECT_NEAR(automatic_exposure(grey(100, 0.7f * 8), 10), ev - 3, 1e-9);
}

TEST(AutomaticExposure, counts_what_is_covered_alone) {
    std::vector<float> rgba = grey(64 * 64, 0.5f);
    for (std::size_t i = 0; i < 64 * 32; ++i)
        for (int c = 0; c < 4; ++c) rgba[4 * i + c] = 0;
    EXPECT_EQ(automatic_exposure(rgba, 64), automatic_exposure(grey(64 * 32, 0.5f), 64));
}

TEST(AutomaticExposure, of_single_noisy_pixels_is_that_of_their_mean) {
    std::vector<float> rgba = grey(64 * 64, 0);
    for (std::size_t y = 0; y < 64; y += 4)
        for (std::size_t x = 0; x < 64; x += 4)
            for (int c = 0; c < 3; ++c) rgba[4 * (64 * y + x) + c] = 16 * 0.18f;
    EXPECT_EQ(automatic_exposure(rgba, 64), 0);
}

TEST(AutomaticExposure, of_a_lamp_in_the_night_shows_the_lamp) {
    std::vector<float> rgba = grey(64 * 64, 0);
    for (std::size_t i = 0; i < 64 * 8; ++i)
        for (int c = 0; c < 3; ++c) rgba[4 * i + c] = 1;
    // seven eighths at 1/512, an eighth at 1
    EXPECT_NEAR(automatic_exposure(rgba, 64), std::log2(0.18) + 9 * 7 / 8.0, 0.051);
}

TEST(AutomaticExposure, of_nothing_is_none) {
    EXPECT_EQ(automatic_exposure(grey(64, 0), 8), 0);
    EXPECT_EQ(automatic_exposure(grey(64, 1, 0), 8), 0);
    EXPECT_EQ(automatic_exposure(grey(0, 1), 8), 0);
    EXPECT_EQ(automatic_exposure(grey(64, INFINITY), 8), 0);
    EXPECT_EQ(automatic_exposure(grey(64, 1e-30f), 8), 64);
}
