#include "bench/error_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace triad {
namespace {

/// relMSE and seconds of every repetition, on every scene; an earlier budget that must not count.
ErrorBench bench_of(const std::vector<std::string>& scenes, const std::vector<double>& relmse,
                    double seconds) {
    ErrorBench bench;
    bench.settings = {{"default", "", "", ""}};
    for (const std::string& scene : scenes) {
        bench.curves.push_back({scene, "default"});
        for (unsigned i = 0; i < relmse.size(); ++i) {
            bench.runs.push_back({scene, "default", i, i, 32, seconds / 2, 0, 0, 100 * relmse[i]});
            bench.runs.push_back({scene, "default", i, i, 64, seconds, 0, 0, relmse[i]});
        }
    }
    return bench;
}

TEST(ErrorScore, HalfOfTheTimeIsTwiceTheScore) {
    const std::map<std::string, double> baselines = {{"a", 10}, {"b", 10}};
    const ErrorBench slow = bench_of({"a", "b"}, {0.05, 0.05, 0.05}, 2),
                     fast = bench_of({"a", "b"}, {0.05, 0.05, 0.05}, 1);
    EXPECT_NEAR(score_settings(slow, baselines)[0].score->value, 100, 1e-9);
    EXPECT_NEAR(score_settings(fast, baselines)[0].score->value, 200, 1e-9);
    EXPECT_NEAR(*scene_efficiency(fast, "a", "default"), 20, 1e-9);
}

TEST(ErrorScore, IsTheGeometricMeanOverScenes) {
    const ErrorBench bench = bench_of({"a", "b"}, {0.1, 0.1, 0.1}, 1);
    EXPECT_NEAR(score_settings(bench, {{"a", 10 / 4.0}, {"b", 10}})[0].score->value, 200, 1e-9);
}

TEST(ErrorScore, IntervalIsStudentsOfOneScene) {
    // Logarithms of the efficiencies differ by -.1, 0 and .1: standard error .1 / sqrt(3), t of 2
    // degrees 4.302653.
    const ErrorBench bench = bench_of({"a"}, {0.1 * std::exp(-0.1), 0.1, 0.1 * std::exp(0.1)}, 1);
    const Estimate score = *score_settings(bench, {{"a", 10}})[0].score;
    EXPECT_NEAR(score.value, 100, 1e-9);
    EXPECT_NEAR(std::log(score.high / 100), 4.302653 * 0.1 / std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(std::log(score.low / 100), -4.302653 * 0.1 / std::sqrt(3.0), 1e-6);
}

TEST(ErrorScore, IntervalHoldsTheTruthNineteenTimesInTwenty) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise;
    int held = 0;
    constexpr int trials = 2000;
    for (int trial = 0; trial < trials; ++trial) {
        ErrorBench bench;
        bench.settings = {{"default", "", "", ""}};
        std::map<std::string, double> baselines;
        for (const auto& [scene, spread] :
             std::map<std::string, double>{{"a", 0.02}, {"b", 0.3}, {"c", 0.1}}) {
            for (unsigned i = 0; i < 5; ++i)
                bench.runs.push_back({scene, "default", i, i, 64, 1, 0, 0, std::exp(spread * noise(random))});
            baselines[scene] = 1;
        }
        const Estimate score = *score_settings(bench, baselines)[0].score;
        held += score.low <= 100 && 100 <= score.high;
    }
    EXPECT_NEAR(double(held) / trials, 0.95, 0.02);  // four standard errors
}

TEST(ErrorScore, OneRepetitionHasNoInterval) {
    const Estimate score = *score_settings(bench_of({"a"}, {0.1}, 1), {{"a", 10}})[0].score;
    EXPECT_NEAR(score.value, 100, 1e-9);
    EXPECT_EQ(score.low, 0);
    EXPECT_EQ(score.high, INFINITY);
}

TEST(ErrorScore, WrongPictureVoidsIt) {
    ErrorBench bench = bench_of({"a", "b"}, {0.1, 0.1}, 1);
    bench.curves[1].right = false;
    const SettingScore score = score_settings(bench, {{"a", 1}, {"b", 1}})[0];
    EXPECT_TRUE(score.is_void);
    EXPECT_FALSE(score.score);
}

TEST(ErrorScore, MissingSceneAndLostErrorGiveNone) {
    const ErrorBench bench = bench_of({"a"}, {0.1, 0.1, 0.1}, 1);
    EXPECT_FALSE(score_settings(bench, {{"a", 1}, {"b", 1}})[0].score);
    const ErrorBench lost = bench_of({"a"}, {-0.1, -0.1, 0.1}, 1);
    const SettingScore score = score_settings(lost, {{"a", 1}})[0];
    EXPECT_FALSE(score.score);
    EXPECT_FALSE(score.is_void);
    EXPECT_FALSE(scene_efficiency(lost, "a", "default"));
}

}  // namespace
}  // namespace triad
