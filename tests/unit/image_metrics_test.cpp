// Metrics against values computed by hand.
#include "metric/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace triad;

namespace {
const std::vector<float> picture{1.0f, 0.5f, 0.0f, 3.0f},
    reference{1.0f, 0.0f, 1.0f, 1.0f};  // errors 0, .5, -1, 2
}

TEST(ImageMetrics, by_hand) {
    EXPECT_DOUBLE_EQ(mean_absolute_error(picture, reference), 3.5 / 4);
    EXPECT_DOUBLE_EQ(rmse(picture, reference), std::sqrt(5.25 / 4));
    EXPECT_DOUBLE_EQ(relmse(picture, reference), (0.25 / 0.01 + 1 / 1.01 + 4 / 1.01) / 4);
    EXPECT_DOUBLE_EQ(psnr(picture, reference), 10 * std::log10(4 / 5.25));
    EXPECT_DOUBLE_EQ(psnr(picture, reference, 10.0), 10 * std::log10(400 / 5.25));
}

TEST(ImageMetrics, equal_pictures) {
    EXPECT_EQ(rmse(picture, picture), 0.0);
    EXPECT_EQ(relmse(picture, picture), 0.0);
    EXPECT_TRUE(std::isinf(psnr(picture, picture)) && psnr(picture, picture) > 0);
}

TEST(ImageMetrics, the_reference_is_the_second) {
    EXPECT_NE(relmse(picture, reference), relmse(reference, picture));
}

TEST(ImageMetrics, a_nan_is_never_dropped) {
    const std::vector<float> broken{1.0f, NAN, 0.0f, 3.0f};
    EXPECT_TRUE(std::isnan(rmse(broken, reference)));
    EXPECT_TRUE(std::isnan(relmse(broken, reference)));
}

TEST(ImageMetrics, different_sizes_are_refused) {
    EXPECT_THROW(rmse(std::vector<float>(3), reference), std::invalid_argument);
    EXPECT_THROW(rmse({}, {}), std::invalid_argument);
}
