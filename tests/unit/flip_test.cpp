// FLIP against the values of its authors' own program.
#include "metric/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace triad {
namespace {

/// Two ramps and a chequered channel; the other picture has less red and blue dots.
RgbImage pattern(bool changed) {
    constexpr unsigned width = 48, height = 32;
    RgbImage image{width, height, {}};
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x) {
            const float red = float(x) / (width - 1), blue = (x / 8 + y / 8) % 2 ? 0.8f : 0.0f;
            image.rgb.push_back(changed ? 0.8f * red : red);
            image.rgb.push_back(float(y) / (height - 1));
            image.rgb.push_back(changed && (x * 7 + y * 13) % 11 == 0 ? 1.0f : blue);
        }
    return image;
}

// flip_evaluator 1.7 (PyPI): evaluate(reference, picture, "LDR", applyMagma=False) of these pictures through
// the sRGB curve, as float32, at its own 67.02 pixels per degree.
TEST(Flip, gives_the_values_of_the_authors_program) {
    const std::vector<float> map = flip_map(pattern(true), pattern(false));
    ASSERT_EQ(map.size(), 48u * 32u);
    EXPECT_NEAR(mean_flip(map), 0.25929388, 1e-5);
    EXPECT_NEAR(map[0], 0.76653165, 1e-4);
    EXPECT_NEAR(map[31 * 48 + 47], 0.50934529, 1e-4);
    EXPECT_NEAR(map[16 * 48 + 20], 0.23294941, 1e-4);
    EXPECT_NEAR(map[5 * 48 + 33], 0.32536018, 1e-4);
    EXPECT_NEAR(map[30 * 48 + 10], 0.36138541, 1e-4);
}

TEST(Flip, equal_pictures_have_none_and_opposite_ones_all) {
    for (const float v : flip_map(pattern(true), pattern(true))) EXPECT_EQ(v, 0);
    const auto plain = [](float r, float g, float b) {
        RgbImage image{16, 16, {}};
        for (int i = 0; i < 256; ++i) image.rgb.insert(image.rgb.end(), {r, g, b});
        return image;
    };
    // The largest distance of colour is that of green and blue, by definition.
    EXPECT_NEAR(mean_flip(flip_map(plain(0, 1, 0), plain(0, 0, 1))), 1, 1e-5);
    // Beyond the display's range nothing is to be seen.
    EXPECT_EQ(mean_flip(flip_map(plain(7, 1, -1), plain(1, 1, 0))), 0);
    EXPECT_EQ(mean_flip(flip_map(plain(NAN, 1, 0), plain(0, 1, 0))), 0);
}

TEST(Flip, sees_less_from_farther_away) {
    const RgbImage a = pattern(true), b = pattern(false);
    EXPECT_LT(mean_flip(flip_map(a, b, 200)), mean_flip(flip_map(a, b, 30)));
}

TEST(Flip, wants_one_size) {
    EXPECT_THROW(flip_map(pattern(true), RgbImage{2, 2, std::vector<float>(12)}), std::invalid_argument);
    EXPECT_THROW(flip_map({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace triad
