// How large launches become, on devices that are made up.
#include "trace/launch_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace triad {
namespace {

/// Seconds of a launch: its longest path, and its samples.
struct MadeUp {
    double longest_path, rate, noise = 0;
    std::mt19937 random{1};

    double seconds(double samples) {
        return (longest_path + samples / rate) *
               (1 + noise * std::uniform_real_distribution<double>(-1, 1)(random));
    }
};

struct Launches {
    double longest = 0, last = 0, samples = 0, seconds = 0;
};

/// The first has 1024 samples.
Launches launch(MadeUp device, double seconds, int times) {
    LaunchTimes known;
    Launches all;
    EXPECT_EQ(known.samples_in(seconds), 0);
    double samples = 1024;
    for (int i = 0; i < times; ++i) {
        all.last = device.seconds(samples);
        all.samples += samples, all.seconds += all.last;
        known.add(samples, all.last);
        if (i > 0) all.longest = std::max(all.longest, all.last);
        samples = known.samples_in(seconds);
    }
    return all;
}

TEST(LaunchTimes, are_what_is_asked_for_where_all_samples_take_the_same) {
    for (const double rate : {1e4, 1e6, 1e9}) {
        const Launches all = launch({0, rate}, 0.05, 20);
        EXPECT_NEAR(all.last, 0.05, 1e-6) << rate;
        EXPECT_LE(all.longest, 0.0501) << rate;
    }
}

TEST(LaunchTimes, are_not_far_longer_where_they_scatter) {
    for (unsigned seed = 1; seed <= 50; ++seed)
        EXPECT_LE(launch({0, 1e6, 0.3, std::mt19937(seed)}, 0.05, 100).longest, 0.25) << seed;
}

// Or else a launch would become smaller for what does not depend on its size, without end.
TEST(LaunchTimes, grow_where_the_longest_path_is_most_of_them) {
    const double rate = 6e7;
    for (const double path : {0.04, 0.1}) {
        const Launches all = launch({path, rate}, 0.05, 30);
        EXPECT_NEAR(all.last, 2 * path, 0.02 * path) << path;
        EXPECT_GT(all.samples / all.seconds, 0.35 * rate) << path << ", with the first ones";
    }
    const Launches all = launch({10, rate}, 0.05, 30);
    EXPECT_LE(all.longest, 12.6) << "the path alone takes longer than anyone waits";
    EXPECT_GT(all.samples / all.seconds, 0.1 * rate);
}

// The last launch of a list has what is left.
TEST(LaunchTimes, small_ones_between_change_little) {
    for (const double path : {0.0, 0.1}) {
        MadeUp device{path, 6e7};
        LaunchTimes known;
        double samples = 1024, took = 0;
        for (int i = 0; i < 40; ++i) {
            if (i % 4 == 3) known.add(samples / 50, device.seconds(samples / 50));
            samples = known.samples_in(0.05) > 0 ? known.samples_in(0.05) : samples;
            took = device.seconds(samples);
            known.add(samples, took);
        }
        EXPECT_NEAR(took, std::max(0.05, 2 * path), 0.01) << path;
    }
}

TEST(LaunchTimes, grow_fast) { EXPECT_GT(launch({0.25, 1e8}, 0.4, 10).last, 0.4); }

TEST(LaunchTimes, follow_a_picture_that_becomes_harder) {
    LaunchTimes known;
    double samples = 1024, took = 0;
    for (int i = 0; i < 30; ++i) {
        took = samples / (i < 15 ? 1e8 : 1e6);
        known.add(samples, took);
        samples = known.samples_in(0.05);
    }
    EXPECT_NEAR(took, 0.05, 0.001);
}

}  // namespace
}  // namespace triad
