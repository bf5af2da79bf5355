// From rows to curves, to CSV and back, and against older rows.
#include "bench/error_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "bench/error_csv.h"

namespace triad {
namespace {

/// relMSE = error / spp^(-2 slope) with 3 % noise, `pace` seconds a sample, budgets 1 to 64.
std::vector<ErrorRun> make_runs(const std::string& setting, double error, double slope, double pace,
                                unsigned seed, double reference = 1e-9) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<ErrorRun> runs;
    for (unsigned repetition = 0; repetition < 5; ++repetition)
        for (double spp = 1; spp <= 64; spp *= 2) {
            ErrorRun run;
            run.scene = "room", run.setting = setting, run.repetition = repetition, run.seed = repetition + 1;
            run.spp = spp, run.seconds = pace * spp * std::exp(0.02 * normal(random));
            run.relmse = error * std::pow(spp, 2 * slope) * std::exp(0.03 * normal(random));
            run.mse = 2 * run.relmse;
            run.relmse_trimmed = run.relmse, run.reference_relmse = reference;
            run.fireflies = repetition, run.nan = 1;
            runs.push_back(run);
        }
    return runs;
}

std::vector<ErrorRun> together(std::vector<ErrorRun> a, const std::vector<ErrorRun>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(ErrorCurves, slope_efficiency_and_time_ratio_are_those_of_the_power_laws) {
    const auto curves =
        curves_of(together(make_runs("plain", 0.5, -0.5, 0.1, 1), make_runs("better", 0.25, -0.5, 0.15, 2)));
    ASSERT_EQ(curves.size(), 2u);
    for (const ErrorCurve& c : curves) {
        ASSERT_EQ(c.points.size(), 7u);
        EXPECT_NEAR(c.slope->value, -0.5, 0.01);
        EXPECT_LT(c.slope->low, -0.5);
        EXPECT_GT(c.slope->high, -0.5);
        EXPECT_EQ(c.points.back().fireflies, 2);  // the median
        EXPECT_EQ(c.points.back().nan, 5u);       // the sum
    }
    EXPECT_NEAR(curves[0].efficiency->value, 1 / (2 * 0.5 / 64 * 6.4), 0.5);
    EXPECT_EQ(curves[0].time_ratio->value, 1);
    EXPECT_EQ(curves[0].time_ratio->low, 1);
    EXPECT_NEAR(curves[1].time_ratio->value, 0.75, 0.1);  // half of the samples, each half as dear again
    EXPECT_NEAR(curves[1].equal_relmse, 0.5 / 64, 0.0005);
}

TEST(ErrorCurves, points_below_the_noise_of_the_reference_are_not_fitted) {
    // Noise that is a third of a median's value there would bend the line.
    auto runs = make_runs("plain", 0.5, -0.5, 0.1, 3, 0.02);
    for (ErrorRun& r : runs)
        if (r.spp > 16) r.relmse = r.repetition % 2 ? -1e-3 : 1e-6;
    const auto curves = curves_of(runs);
    EXPECT_TRUE(curves[0].points[4].fitted);
    EXPECT_FALSE(curves[0].points[5].fitted);
    EXPECT_FALSE(curves[0].points[6].fitted);
    EXPECT_NEAR(curves[0].slope->value, -0.5, 0.02);
    EXPECT_NEAR(curves[0].equal_relmse, 0.5 / 16, 0.002);
}

TEST(ErrorCurves, runs_that_were_cut_short_count_as_far_as_they_go) {
    auto runs = make_runs("plain", 0.5, -0.5, 0.1, 4);
    runs.resize(runs.size() - 3);  // the last repetition was interrupted
    const auto curves = curves_of(runs);
    ASSERT_EQ(curves[0].points.size(), 7u);
    EXPECT_NEAR(curves[0].slope->value, -0.5, 0.02);
    EXPECT_EQ(curves[0].points[3].nan, 5u);
    EXPECT_EQ(curves[0].points[4].nan, 4u);
}

TEST(ErrorCurves, without_an_error_in_common_there_is_no_ratio) {
    auto hopeless = make_runs("hopeless", 0.5, -0.5, 0.1, 5);
    for (ErrorRun& r : hopeless) r.relmse = -1e-3;
    const auto curves = curves_of(together(make_runs("plain", 0.5, -0.5, 0.1, 6), hopeless));
    EXPECT_FALSE(curves[1].time_ratio);
    EXPECT_FALSE(curves[1].slope);
}

TEST(ErrorChanges, better_worse_and_the_same) {
    const auto before = make_runs("a", 0.5, -0.5, 0.1, 7);
    const auto verdict = [&](double error, double pace, unsigned seed) {
        const auto changes = changes_of(before, make_runs("a", error, -0.5, pace, seed));
        EXPECT_EQ(changes.size(), 1u);
        EXPECT_NEAR(changes.at(0).time_ratio.value, error / 0.5 * pace / 0.1, 0.06);
        EXPECT_NEAR(changes.at(0).error_ratio->value, error / 0.5, 0.06);
        return changes.at(0).verdict;
    };
    EXPECT_EQ(verdict(0.5, 0.1, 8), ErrorChange::Verdict::same);
    EXPECT_EQ(verdict(0.4, 0.1, 9), ErrorChange::Verdict::better);
    EXPECT_EQ(verdict(0.5, 0.13, 10), ErrorChange::Verdict::worse);
    EXPECT_TRUE(changes_of(before, make_runs("b", 0.5, -0.5, 0.1, 11)).empty());
}

TEST(ErrorChanges, noise_alone_is_seldom_called_a_change) {
    int called = 0;
    constexpr int experiments = 200;
    for (unsigned i = 0; i < experiments; ++i) {
        const auto changes =
            changes_of(make_runs("a", 0.5, -0.5, 0.1, 100 + i), make_runs("a", 0.5, -0.5, 0.1, 1000 + i));
        called += changes.at(0).verdict != ErrorChange::Verdict::same;
    }
    EXPECT_LE(called, 24);  // 10 expected, deviation 3.1: 4.5 deviations
    EXPECT_GE(called, 1);   // a test that never speaks is none
}

TEST(ErrorCsv, comes_back_exactly) {
    auto runs = make_runs("a, \"quoted\"", 1.0 / 3, -0.51, 0.1, 12);
    runs[1].relmse = -1e-300, runs[2].mse = 12345678901234567.0;
    const auto back = runs_from_csv("test.csv", csv_of(runs));
    ASSERT_EQ(back.size(), runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        EXPECT_EQ(back[i].setting, runs[i].setting);
        EXPECT_EQ(back[i].relmse, runs[i].relmse);
        EXPECT_EQ(back[i].mse, runs[i].mse);
        EXPECT_EQ(back[i].seconds, runs[i].seconds);
        EXPECT_EQ(back[i].seed, runs[i].seed);
        EXPECT_EQ(back[i].nan, runs[i].nan);
    }
}

TEST(ErrorCsv, columns_may_be_in_any_order_and_more) {
    std::string text = csv_of(make_runs("a", 0.5, -0.5, 0.1, 13));
    std::string mirrored;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin), comma = text.find(',', begin);
        mirrored +=
            text.substr(comma + 1, end - comma - 1) + ",more," + text.substr(begin, comma - begin) + "\r\n";
        begin = end + 1;
    }
    EXPECT_EQ(csv_of(runs_from_csv("test.csv", mirrored)), text);
}

TEST(ErrorCsv, what_is_wrong_is_named) {
    const std::string text = csv_of(make_runs("a", 0.5, -0.5, 0.1, 14));
    const auto complaint = [](const std::string& csv) {
        try {
            runs_from_csv("old.csv", csv);
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::scene);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(complaint("").find("no column scene"), std::string::npos);
    EXPECT_NE(complaint(text + "room,a\n").find("record 37"), std::string::npos);
    EXPECT_NE(complaint(text + "\"").find("quote"), std::string::npos);
    std::string slip = text;
    slip.replace(slip.find("room,a,0,1,1,") + 9, 1, "x");
    EXPECT_NE(complaint(slip).find("seed is x"), std::string::npos);
}

}  // namespace
}  // namespace triad
