// When a render stops and how its rounds are sized, with a clock and an error that the tests make up.
#include "render/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace triad;

namespace {

/// A picture whose error and pace are known: relMSE = error_at_one n^slope.
struct NoisyPicture {
    double error_at_one = 1, slope = -1, seconds_per_sample = 0.1;
    double scatter = 0;  ///< relative, of the estimates
    double slower = 0;   ///< by how much samples beyond 16 take longer, as adaptive ones may
    std::mt19937 random{1};

    double error(double samples) const { return error_at_one * std::pow(samples, slope); }
    double estimate(double samples) {
        return error(samples) * std::exp(std::normal_distribution<double>(0, scatter)(random));
    }
    double seconds(double from, double to) const {
        return (to - from + slower * (std::max(to, 16.0) - std::max(from, 16.0))) * seconds_per_sample;
    }
};

struct Followed {
    double samples = 0, seconds = 0;
    int rounds = 0;
    Stop stop = Stop::samples;
};

/// What the renderer does with a schedule: passes of a sample, or finer ones where sampling is adaptive.
Followed follow(const RenderGoal& goal, NoisyPicture picture) {
    Schedule schedule(goal, 1);
    Followed o;
    while (const auto end = schedule.next_round(o.samples, o.seconds)) {
        EXPECT_GT(*end, o.samples);
        while (o.samples < *end - 1e-9 && !schedule.time_is_up(o.samples, o.seconds)) {
            const bool cut = o.samples >= 1 && schedule.may_end_within_sample(o.samples, o.seconds);
            const double pass = cut ? 0.01 : 1.0;
            const double next = std::min(o.samples + pass, *end);
            o.seconds += picture.seconds(o.samples, next);
            o.samples = next;
        }
        if (schedule.needs_estimate()) schedule.add_estimate(o.samples, picture.estimate(o.samples));
        if (++o.rounds > 100) {
            ADD_FAILURE() << "the schedule does not come to an end";
            break;
        }
    }
    o.stop = schedule.stop_reason();
    return o;
}

constexpr std::uint64_t no_limit = 1u << 30;

}  // namespace

TEST(Schedule, samples_alone_are_one_round) {
    const Followed o = follow({.samples = {5, 69}}, {});
    EXPECT_EQ(o.samples, 64);
    EXPECT_EQ(o.rounds, 1);
    EXPECT_EQ(o.stop, Stop::samples);
}

TEST(Schedule, the_error_asked_for_is_reached_and_not_by_far) {
    for (const bool adaptive : {false, true})
        for (const double slope : {-0.8, -1.0, -1.4})
            for (const double error : {0.05, 0.002, 1e-5}) {
                const NoisyPicture picture{.slope = slope};
                const Followed o =
                    follow({.samples = {0, no_limit}, .error = error, .adaptive = adaptive}, picture);
                EXPECT_EQ(o.stop, Stop::error);
                EXPECT_LT(picture.error(o.samples), 1.02 * error) << slope;
                const double less = o.samples - std::max(1.0, 0.1 * o.samples);
                EXPECT_TRUE(o.samples == 4 || picture.error(less) > error) << slope << ", " << error;
                EXPECT_LT(o.rounds, 40);
            }
}

TEST(Schedule, an_error_is_sought_where_points_lie_well) {
    const auto samples_for = [](double error) {
        return follow({.samples = {0, no_limit}, .error = error}, {.slope = -1}).samples;
    };
    EXPECT_EQ(samples_for(1 / 64.9), 64) << "less than two percent above the error";
    EXPECT_EQ(samples_for(1 / 97.5), 96);
    EXPECT_EQ(samples_for(1 / 80.0), 80) << "none is near";
    EXPECT_EQ(samples_for(1 / 63.0), 64);
    EXPECT_EQ(samples_for(1 / 7.5), 8) << "few samples: by the error alone";
    EXPECT_EQ(samples_for(1 / 11.0), 11);
}

TEST(Schedule, estimates_that_scatter_do_not_move_the_error_reached) {
    std::vector<double> ratios;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const NoisyPicture picture{.slope = -1.1, .scatter = 0.05, .random = std::mt19937(seed)};
        const Followed o = follow({.samples = {0, no_limit}, .error = 0.001, .adaptive = true}, picture);
        ratios.push_back(picture.error(o.samples) / 0.001);
        EXPECT_GT(ratios.back(), 1 / 1.5) << seed;
        EXPECT_LT(ratios.back(), 1.2) << seed;
    }
    std::nth_element(ratios.begin(), ratios.begin() + 100, ratios.end());
    EXPECT_NEAR(ratios[100], 1.0, 0.1);
}

TEST(Schedule, the_time_asked_for_is_used_and_not_exceeded) {
    for (const double slower : {-0.5, 0.0, 2.0})
        for (const double seconds : {2.5, 10.0, 1000.0}) {
            const RenderGoal goal{.samples = {0, no_limit}, .seconds = seconds, .adaptive = true};
            const Followed o = follow(goal, {.slower = slower});
            EXPECT_EQ(o.stop, Stop::time);
            EXPECT_GT(o.seconds, 0.95 * seconds) << slower;
            EXPECT_LT(o.seconds, 1.01 * seconds) << slower;
        }
}

TEST(Schedule, even_renders_end_after_whole_samples_where_that_misses_the_time_by_little) {
    for (const double seconds : {2.51, 7.77, 100.0}) {
        const Followed o = follow({.samples = {0, no_limit}, .seconds = seconds}, {});
        EXPECT_EQ(o.stop, Stop::time);
        EXPECT_LE(std::abs(o.seconds - seconds), 0.05 + 1e-9) << seconds;
        EXPECT_EQ(o.samples, std::round(o.samples));
    }
}

TEST(Schedule, even_renders_of_few_samples_end_within_one) {
    for (const double slower : {-0.5, 0.0, 2.0})
        for (const double seconds : {0.14, 0.36, 1.05, 2.3}) {
            const Followed o = follow({.samples = {0, no_limit}, .seconds = seconds}, {.slower = slower});
            EXPECT_EQ(o.stop, Stop::time);
            EXPECT_NEAR(o.seconds, seconds, 0.05 * seconds) << slower;
        }
}

TEST(Schedule, a_time_shorter_than_one_sample_gives_one_sample) {
    for (const bool adaptive : {false, true}) {
        const Followed o = follow({.samples = {0, no_limit}, .seconds = 0.01, .adaptive = adaptive}, {});
        EXPECT_EQ(o.samples, 1);
        EXPECT_EQ(o.stop, Stop::time);
    }
}

TEST(Schedule, whichever_goal_is_first_ends_it) {
    const NoisyPicture picture{};  // 0.1 s a sample, relMSE 1 / n
    EXPECT_EQ(follow({.samples = {0, 50}, .error = 0.01, .seconds = 9}, picture).stop, Stop::samples);
    EXPECT_EQ(follow({.samples = {0, 150}, .error = 0.01, .seconds = 20}, picture).stop, Stop::error);
    EXPECT_EQ(follow({.samples = {0, 150}, .error = 0.01, .seconds = 5}, picture).stop, Stop::time);
}

TEST(Schedule, a_picture_without_noise_stops_at_the_first_look) {
    const Followed o = follow({.samples = {0, no_limit}, .error = 0.01}, {.error_at_one = 0});
    EXPECT_EQ(o.samples, 4);
    EXPECT_EQ(o.stop, Stop::error);
}

TEST(Schedule, the_first_look_comes_when_every_bin_has_both_halves) {
    Schedule schedule({.samples = {0, no_limit}, .error = 0.01}, 9);
    EXPECT_EQ(schedule.next_round(0, 0), 18.0);
}

TEST(Schedule, even_renders_give_every_bin_as_many_samples) {
    Schedule schedule({.samples = {0, no_limit}, .error = 0.01, .seconds = 100}, 9);
    double samples = 0;
    for (int round = 0; round < 5; ++round) {
        const auto end = schedule.next_round(samples, samples);
        ASSERT_TRUE(end);
        EXPECT_EQ(std::fmod(*end, 9), 0) << *end;
        samples = *end;
        schedule.add_estimate(samples, 1 / samples);
    }
    EXPECT_EQ(Schedule({.samples = {0, 64}}, 9).next_round(0, 0), 64.0) << "what was asked for exactly";
}

// A render that was stopped during its last sample lacks it in some tiles.
TEST(Schedule, even_renders_that_go_on_end_with_all_that_was_asked_for) {
    EXPECT_EQ(Schedule({.samples = {0, 6}}, 1).next_round(5.999, 1), 6.0);
    EXPECT_FALSE(Schedule({.samples = {0, 6}}, 1).next_round(6, 1));
    EXPECT_FALSE(Schedule({.samples = {0, 6}, .adaptive = true}, 1).next_round(5.8, 1)) << "near its mark";
}

TEST(Schedule, adaptive_rounds_never_more_than_double_the_samples) {
    Schedule schedule({.samples = {0, 1000}, .adaptive = true}, 1);
    double samples = 0;
    while (const auto end = schedule.next_round(samples, samples)) {
        EXPECT_LE(*end, std::max(4.0, 2 * samples));
        samples = *end;
    }
    EXPECT_EQ(samples, 1000);
}

TEST(Trend, is_the_slope_of_the_logarithms) {
    Trend trend;
    for (const double n : {4.0, 8.0, 12.0, 16.0}) trend.add(n, 3 * std::pow(n, -1.25));
    ASSERT_TRUE(trend.slope());
    EXPECT_NEAR(*trend.slope(), -1.25, 1e-12);
    EXPECT_NEAR(trend.samples_for(3 * std::pow(100, -1.25)), 100, 1e-9);
}

TEST(Trend, is_not_told_from_less_than_half_an_octave_or_from_long_ago) {
    Trend trend;
    EXPECT_FALSE(trend.slope());
    trend.add(100, 0.5);
    trend.add(120, 0.1);
    EXPECT_FALSE(trend.slope());
    for (const double n : {1000.0, 2000.0, 4000.0}) trend.add(n, 1 / n);
    EXPECT_NEAR(*trend.slope(), -1, 1e-12);
}

TEST(Trend, a_second_look_at_the_same_samples_replaces_the_first) {
    Trend trend;
    trend.add(4, 0.25);
    trend.add(8, 1);
    trend.add(8, 0.125);
    EXPECT_NEAR(*trend.slope(), -1, 1e-12);
}
