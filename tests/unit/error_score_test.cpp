#include "measure/error_score.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(ErrorScore, IntervalHoldsTheValueAndGrowsWithNoise) {
    const std::map<std::string, double> baselines = {{"a", 10}};
    const auto narrow =
        *score_settings(bench_of({"a"}, {0.099, 0.1, 0.1, 0.1, 0.101}, 1), baselines)[0].score;
    const auto wide = *score_settings(bench_of({"a"}, {0.05, 0.08, 0.1, 0.15, 0.2}, 1), baselines)[0].score;
    EXPECT_LE(narrow.low, narrow.value);
    EXPECT_GE(narrow.high, narrow.value);
    EXPECT_LT(narrow.high / narrow.low, 1.03);
    EXPECT_GT(wide.high / wide.low, 1.5);
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
