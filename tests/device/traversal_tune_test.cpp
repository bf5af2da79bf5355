// Work-group sizes and formats of nodes: they change the time and nothing else, and the search keeps what it
// found.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "check/tracer.h"
#include "device_fixture.h"
#include "trace/tune.h"

using namespace triad;
using namespace triad::traversal_case;

namespace {

/// Puts the device's size back, and keeps the user's cache out of the test.
class TraversalTune : public ::testing::Test {
  protected:
    TraversalTune() {
        if (const char* old = std::getenv("XDG_CACHE_HOME")) old_cache_ = old;
        std::filesystem::remove_all(folder_);
        setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    }
    ~TraversalTune() override {
        test_device().set_preferred_local(local_);
        set_format(test_device(), format_);
        old_cache_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", old_cache_.c_str(), 1);
        std::filesystem::remove_all(folder_);
    }

  private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("triad-tune-" + std::to_string(getpid()));
    std::string old_cache_;
    std::size_t local_ = test_device().preferred_local();
    BvhFormat format_ = format_of(test_device());
};

TEST_F(TraversalTune, the_work_group_size_changes_no_bit) {
    World world;
    world.origin_reach = 2.0f;
    world.add(0, shapes::displaced_sphere(vec3(0.0f), 1.0f, 40, 30, 0.3f, 3.0f, 1));
    const Tracer tracer(test_device(), world);
    Random random(1);
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 5000; ++i) rays.push_back(ray(random.in_cube(0.5), random.direction()));
    test_device().set_preferred_local(64);
    const auto expected = tracer.closest(rays);
    for (const std::size_t local : {1u, 8u}) {
        test_device().set_preferred_local(local);
        const auto hits = tracer.closest(rays);
        EXPECT_EQ(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(dev::Hit)), 0) << local;
    }
}

TEST_F(TraversalTune, keeps_what_is_fastest_and_measures_once) {
    Device& device = test_device();
    ASSERT_FALSE(load_timings(device.info()));
    const Tuning found = ensure_tuned(device);
    const auto timings = load_timings(device.info());
    ASSERT_TRUE(timings);
    EXPECT_GE(timings->size(), 2u) << "both formats at least";
    EXPECT_EQ(best_of(*timings), found);
    EXPECT_EQ(name_of(format_of(device)), found.at("format"));
    EXPECT_EQ(std::to_string(device.preferred_local()), found.at("local"));
    auto others = *timings;
    for (TuneTiming& timing : others) timing.seconds = timing.values == found ? 2.0 : 1.0;
    keep_timings(device.info(), others);
    EXPECT_NE(ensure_tuned(device), found) << "what is kept is used, not measured again";
}

TEST_F(TraversalTune, a_wish_is_granted_with_what_is_best_beside_it) {
    Device& device = test_device();
    const Tuning best = ensure_tuned(device);
    for (const BvhFormat format : all_bvh_formats) {
        EXPECT_EQ(ensure_tuned(device, {{"format", name_of(format)}}).at("format"), name_of(format));
        EXPECT_EQ(format_of(device), format);
    }
    EXPECT_EQ(ensure_tuned(device), best);
    EXPECT_THROW(ensure_tuned(device, {{"format", "none"}}), Error);
}

TEST(Tuning, prefers_the_first_unless_another_is_clearly_faster) {
    const auto timing = [](const char* format, const char* local, double seconds) {
        return TuneTiming{"rays", {{"format", format}, {"local", local}}, seconds};
    };
    const std::vector<TuneTiming> close{timing("a", "64", 1.0), timing("a", "8", 0.97),
                                        timing("b", "64", 0.96)};
    EXPECT_EQ(best_of(close), close[0].values);
    const std::vector<TuneTiming> clear{timing("a", "64", 1.0), timing("a", "8", 0.9), timing("b", "64", 0.5),
                                        timing("b", "8", 0.49)};
    EXPECT_EQ(best_of(clear), clear[3].values);
    EXPECT_EQ(best_of(clear, {{"format", "a"}}), clear[1].values);
    EXPECT_EQ(best_of(clear, {{"format", "b"}}), clear[2].values) << "0.49 is not clearly less than 0.5";
    std::vector<TuneTiming> two = clear;
    two.push_back({"paths", {{"driver", "mega"}}, 3.0});
    two.push_back({"paths", {{"driver", "wave"}}, 1.0});
    EXPECT_EQ(best_of(two), (Tuning{{"driver", "wave"}, {"format", "b"}, {"local", "8"}}));
}

}  // namespace
