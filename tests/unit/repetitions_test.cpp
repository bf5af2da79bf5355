// Numbers from repeated measurements: closed forms, and intervals that hold what they promise.
#include "metric/repetitions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace triad {
namespace {

TEST(Repetitions, median_of_few) {
    EXPECT_EQ(median(std::vector{3.0}), 3);
    EXPECT_EQ(median(std::vector{5.0, 1.0}), 3);
    EXPECT_EQ(median(std::vector{9.0, 1.0, 2.0}), 2);
    EXPECT_EQ(median(std::vector{4.0, 9.0, 1.0, 2.0}), 3);
    EXPECT_THROW(median({}), std::invalid_argument);
}

TEST(Repetitions, bootstrap_of_five_is_the_least_and_the_greatest) {
    // P(median of a resample of five is the least) = P(Bin(5, 1/5) >= 3) = .058 > .025.
    const Estimate e = median_estimate(std::vector{5.0, 3.0, 1.0, 4.0, 2.0});
    EXPECT_EQ(e.value, 3);
    EXPECT_EQ(e.low, 1);
    EXPECT_EQ(e.high, 5);
}

/// How often an estimator's interval holds the truth; experiments of n log-normal values.
double coverage(int n, int experiments, double truth, Estimate (*estimate)(std::span<const double>)) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    int held = 0;
    for (int experiment = 0; experiment < experiments; ++experiment) {
        std::vector<double> values;
        for (int i = 0; i < n; ++i) values.push_back(std::exp(0.3 * normal(random)));
        const Estimate e = estimate(values);
        held += e.low <= truth && truth <= e.high;
    }
    return double(held) / experiments;
}

// Standard error of a coverage of .95 from 2000 experiments: .0049; bounds are 4.5 of them away (two-sided
// 7e-6).
TEST(Repetitions, intervals_hold_the_truth_as_often_as_they_say) {
    EXPECT_NEAR(coverage(5, 2000, 1, median_estimate), 1 - 2 * std::pow(0.5, 5), 0.022);
    EXPECT_NEAR(coverage(25, 400, 1, median_estimate), 0.95, 0.049 + 0.01);  // order statistics come in steps
    EXPECT_NEAR(coverage(5, 2000, 1, geometric_mean_estimate), 0.95, 0.022);
    EXPECT_NEAR(coverage(12, 2000, 1, geometric_mean_estimate), 0.95, 0.022);
}

TEST(Repetitions, mean_interval_is_students) {
    const Estimate e = mean_estimate(std::vector{1.0, 2.0, 3.0});
    EXPECT_DOUBLE_EQ(e.value, 2);
    EXPECT_NEAR(e.high - e.value, 4.302652729911275 / std::sqrt(3.0), 1e-9);  // t(.975, 2 dof) s / sqrt(n)
    EXPECT_NEAR(e.value - e.low, e.high - e.value, 1e-12);
    EXPECT_TRUE(std::isinf(mean_estimate(std::vector{1.0}).high));
}

TEST(Repetitions, ratio_of_two_groups) {
    const std::vector<double> a = {std::log(1.0), std::log(2.0)}, b = {std::log(4.0), std::log(8.0)};
    const Estimate e = ratio_estimate(a, b);
    EXPECT_NEAR(e.value, 4, 1e-12);
    // Both have a variance of the mean of (log 2)^2 / 4, so two degrees of freedom.
    const double wide = 4.302652729911275 * std::log(2.0) * std::sqrt(0.5);
    EXPECT_NEAR(std::log(e.high / e.low), 2 * wide, 1e-9);
}

TEST(Repetitions, power_laws_are_found) {
    std::vector<double> x, y;
    for (double v : {1.0, 2.0, 4.0, 8.0, 16.0}) x.push_back(v), y.push_back(3 * std::pow(v, -0.75));
    EXPECT_NEAR(*fit_power(x, y), -0.75, 1e-12);
    EXPECT_FALSE(fit_power(std::vector{2.0, 2.0}, std::vector{1.0, 3.0}));
    EXPECT_FALSE(fit_power(std::vector{2.0}, std::vector{1.0}));
}

TEST(Repetitions, slope_of_noisy_power_laws_is_within_its_interval) {
    // Seven octaves, 10 % noise: the slope's deviation is .1 / sqrt(sum of (log x - mean)^2) = .1 / (log 2
    // sqrt(28)).
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    int held = 0;
    double widths = 0;
    for (int experiment = 0; experiment < 1000; ++experiment) {
        std::vector<double> slopes;
        for (int repetition = 0; repetition < 5; ++repetition) {
            std::vector<double> x, y;
            for (int i = 0; i < 7; ++i) {
                x.push_back(std::exp2(i));
                y.push_back(std::pow(x.back(), -0.5) * std::exp(0.1 * normal(random)));
            }
            slopes.push_back(*fit_power(x, y));
        }
        const Estimate e = mean_estimate(slopes);
        held += e.low <= -0.5 && -0.5 <= e.high;
        widths += (e.high - e.low) / 2000;
    }
    EXPECT_NEAR(held / 1000.0, 0.95, 0.031);  // 4.5 standard errors
    const double deviation = 0.1 / (std::log(2.0) * std::sqrt(28.0));
    // E[s] = .9400 sigma for n = 5
    EXPECT_NEAR(widths, 2.776445105 * 0.94 * deviation / std::sqrt(5.0), 0.05 * deviation);
}

TEST(Repetitions, time_to_an_error_is_interpolated_on_the_power_law) {
    std::vector<TimedError> curve;
    for (double t : {1.0, 2.0, 4.0, 8.0}) curve.push_back({t, 0.1 * std::pow(t, -1.5)});
    EXPECT_NEAR(*seconds_to_error(curve, 0.1 * std::pow(3.0, -1.5)), 3, 1e-12);
    EXPECT_NEAR(*seconds_to_error(curve, 0.1 * std::pow(8.0, -1.5)), 8, 1e-12);
    EXPECT_NEAR(*seconds_to_error(curve, 0.1 * std::pow(16.0, -1.5)), 16, 1e-9);  // beyond the ends
    EXPECT_NEAR(*seconds_to_error(curve, 0.1 * std::pow(0.5, -1.5)), 0.5, 1e-9);
    EXPECT_FALSE(seconds_to_error(curve, 0.1 * std::pow(40.0, -1.5)));  // too far beyond
    EXPECT_FALSE(seconds_to_error({}, 0.1));
}

TEST(Repetitions, a_curve_that_rises_again_is_passed_where_it_stays_below) {
    const std::vector<TimedError> curve = {{1, 0.4}, {2, 0.1}, {4, 0.3}, {8, 0.075}};
    EXPECT_NEAR(*seconds_to_error(curve, 0.15), 4 * std::pow(2.0, 0.5), 1e-12);
    EXPECT_FALSE(seconds_to_error(std::vector<TimedError>{{1, 0.1}, {2, 0.2}}, 0.05));  // it only rises
    EXPECT_FALSE(seconds_to_error(std::vector<TimedError>{{1, 0.1}, {2, -0.01}}, 0.05));
}

}  // namespace
}  // namespace triad
