// Student's t against closed forms and published values, and the comparison of pictures on synthetic noise:
// it must find what differs and leave alone what does not.
#include "metric/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/math.h"

using namespace triad;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void expect_relative(double value, double expected, double tolerance) {
    EXPECT_NEAR(value / expected, 1.0, tolerance) << value << " for " << expected;
}

/// K batches of a grey picture; every value is the mean of `samples` exponential ones: skewed, as light is.
std::vector<Batch> noisy(unsigned count, unsigned width, unsigned height, std::mt19937_64& random,
                         double samples = 1.0, double level = 1.0) {
    std::gamma_distribution<double> sum(samples, level / samples);
    std::vector<Batch> batches(count);
    for (Batch& b : batches) {
        b = {width, height, std::vector<float>(std::size_t(width) * height * 3)};
        for (float& v : b.rgb) v = float(sum(random));
    }
    return batches;
}

}  // namespace

TEST(StudentT, closed_forms_of_one_two_and_infinitely_many_degrees_of_freedom) {
    for (const double t : {1e-8, 0.01, 0.5, 1.0, 2.0, 7.0, 100.0, 1e6, 1e12}) {
        expect_relative(student_t_tail(t, 1.0), 2.0 / pi * std::atan2(1.0, t), 1e-12);
        const double root = std::sqrt(t * t + 2.0);
        expect_relative(student_t_tail(-t, 2.0), 2.0 / (root * (root + t)), 1e-12);
    }
    for (const double t : {0.1, 1.0, 5.0, 20.0})
        expect_relative(student_t_tail(t, infinite), std::erfc(t / std::sqrt(2.0)), 1e-12);
    EXPECT_EQ(student_t_tail(0.0, 5.0), 1.0);
    EXPECT_EQ(student_t_tail(infinite, 5.0), 0.0);
}

TEST(StudentT, many_degrees_of_freedom_lose_no_digits) {
    // To first order in 1/dof, t is a normal variable at z = t (1 - (t^2 + 1) / (4 dof)) (Hill 1970).
    for (const double dof : {1e5, 1e6, 1e7, 9e7})
        for (const double t : {0.5, 2.0, 5.0}) {
            const double z = t * (1.0 - (t * t + 1.0) / (4.0 * dof));
            expect_relative(student_t_tail(t, dof), std::erfc(z / std::sqrt(2.0)),
                            std::pow(t * t + 1.0, 3) / (dof * dof) + 1e-15 * dof);
        }
    // The two ways to the gamma function meet here.
    expect_relative(student_t_tail(3.0, 200.0), student_t_tail(3.0, 200.0 - 1e-9), 1e-11);
}

TEST(StudentT, published_critical_values) {  // two-sided, from the NIST handbook's and the usual tables
    EXPECT_NEAR(student_t_critical(0.05, 1), 12.706, 5e-4);
    EXPECT_NEAR(student_t_critical(0.05, 10), 2.228, 5e-4);
    EXPECT_NEAR(student_t_critical(0.01, 30), 2.750, 5e-4);
    EXPECT_NEAR(student_t_critical(0.001, 7), 5.408, 5e-4);
    EXPECT_NEAR(student_t_critical(0.002, 100), 3.174, 5e-4);
    EXPECT_NEAR(student_t_critical(0.05, infinite), 1.95996, 5e-6);
}

TEST(StudentT, the_critical_value_inverts_the_tail) {
    for (const double dof : {1.0, 2.5, 7.0, 31.0, 1e4, infinite})
        for (const double p : {1e-12, 1e-6, 0.01, 0.5})
            expect_relative(student_t_tail(student_t_critical(p, dof), dof), p, 1e-9);
}

TEST(StudentT, sidak_shares_out_the_family) {
    EXPECT_DOUBLE_EQ(sidak(1e-3, 1), 1e-3);
    for (const std::size_t m : {std::size_t(2), std::size_t(768), std::size_t(786432)})
        EXPECT_NEAR(-std::expm1(double(m) * std::log1p(-sidak(1e-3, m))), 1e-3, 1e-15);
    EXPECT_NEAR(student_t_critical(sidak(1e-3, 64), infinite), 4.32, 5e-3);
    EXPECT_NEAR(student_t_critical(sidak(1e-3, 12288), infinite), 5.36, 5e-3);
}

TEST(StudentT, what_makes_no_sense_throws) {
    EXPECT_THROW(student_t_tail(NAN, 3), std::invalid_argument);
    EXPECT_THROW(student_t_tail(1, 0), std::invalid_argument);
    EXPECT_THROW(student_t_critical(0, 3), std::invalid_argument);
    EXPECT_THROW(welch_test(std::vector{1.0}, std::vector{1.0, 2.0}), std::invalid_argument);
}

TEST(Welch, by_hand) {
    // Means 2 and 5, variances of the means 1/3 and 1: t = 3 / sqrt(4/3), dof = (4/3)^2 / (1/18 + 1/3).
    const WelchTest test = welch_test(std::vector{1.0, 2.0, 3.0}, std::vector{3.0, 4.0, 5.0, 8.0});
    const double variance = 1.0 / 3 + 14.0 / 12;
    EXPECT_DOUBLE_EQ(test.mean_a, 2.0);
    EXPECT_DOUBLE_EQ(test.mean_b, 5.0);
    EXPECT_DOUBLE_EQ(test.t, 3.0 / std::sqrt(variance));
    EXPECT_DOUBLE_EQ(test.dof, variance * variance / (1.0 / 9 / 2 + 14.0 / 12 * 14.0 / 12 / 3));
    EXPECT_DOUBLE_EQ(test.p, student_t_tail(test.t, test.dof));
}

TEST(Welch, values_without_noise_may_differ_by_rounding_only) {
    const std::vector<double> one(4, 1.0), near(4, 1.0 + 1e-7), far(4, 1.001);
    EXPECT_EQ(welch_test(one, one).p, 1.0);
    EXPECT_EQ(welch_test(one, near).p, 0.0);
    EXPECT_GT(welch_test(one, near, 1e-6).p, 0.5);
    EXPECT_EQ(welch_test(one, far, 1e-6).p, 0.0);
}

TEST(ComparePictures, equal_pictures_are_called_different_as_often_as_stated) {
    // Family significance 0.1, 400 pairs: 40 are expected to fail, and 4.5 standard deviations more happen
    // once in 1e5. Skewed noise makes t conservative, so nothing is asked of the lower side but that it
    // happens.
    std::mt19937_64 random(1);
    int failures = 0;
    for (int i = 0; i < 400; ++i) {
        const auto a = noisy(8, 16, 8, random), b = noisy(8, 16, 8, random);
        failures += !compare_pictures(a, b, {.tile = 4, .family = 0.1}).agree;
    }
    EXPECT_LT(failures, 40 + 4.5 * std::sqrt(400 * 0.1 * 0.9));
    EXPECT_GT(failures, 0);
}

TEST(ComparePictures, a_tile_that_is_five_percent_brighter_is_found_and_named) {
    std::mt19937_64 random(2);
    const auto a = noisy(16, 48, 32, random, 64);
    auto b = noisy(16, 48, 32, random, 64);
    EXPECT_TRUE(compare_pictures(a, b).agree);
    for (Batch& batch : b)
        for (unsigned y = 16; y < 32; ++y)
            for (unsigned x = 32; x < 48; ++x)
                for (int c = 0; c < 3; ++c) batch.rgb[(y * 48 + x) * 3 + c] *= 1.05f;
    const Agreement found = compare_pictures(a, b);
    EXPECT_FALSE(found.agree);
    EXPECT_EQ(found.worst_place.substr(0, 9), "tile 2, 1") << found.sentence();
}

TEST(ComparePictures, a_bias_too_small_for_any_tile_shows_in_the_whole_picture) {
    std::mt19937_64 random(3);
    const auto a = noisy(16, 128, 128, random, 16), b = noisy(16, 128, 128, random, 16, 1.01);
    const Agreement found = compare_pictures(a, b);
    EXPECT_FALSE(found.agree);
    EXPECT_EQ(found.worst_place.substr(0, 5), "whole") << found.sentence();
}

TEST(ComparePictures, a_single_nan_is_a_difference) {
    std::mt19937_64 random(4);
    const auto a = noisy(4, 16, 16, random);
    auto b = noisy(4, 16, 16, random);
    EXPECT_TRUE(compare_pictures(a, b).agree);
    b[2].rgb[17] = NAN;
    EXPECT_FALSE(compare_pictures(a, b).agree);
    EXPECT_FALSE(compare_pictures(b, a).agree);
}

TEST(ComparePictures, ragged_tiles_at_the_edges_count_too) {
    std::mt19937_64 random(5);
    const auto a = noisy(16, 18, 17, random);
    auto b = a;
    EXPECT_EQ(compare_pictures(a, b).comparisons, (2u * 2u + 1u) * 3u);
    for (Batch& batch : b)
        batch.rgb[(16 * 18 + 17) * 3 + 1] += 100.0f;  // the last pixel, a share of 2 x 1 pixels
    EXPECT_EQ(compare_pictures(a, b).worst_place, "tile 1, 1, channel G");
}

TEST(ComparePictures, unequal_sizes_throw) {
    std::mt19937_64 random(6);
    const auto a = noisy(2, 8, 8, random);
    EXPECT_THROW(compare_pictures(a, noisy(2, 8, 9, random)), std::invalid_argument);
    EXPECT_THROW(compare_pictures(a, noisy(1, 8, 8, random)), std::invalid_argument);
    EXPECT_THROW(compare_pictures({}, a), std::invalid_argument);
}
