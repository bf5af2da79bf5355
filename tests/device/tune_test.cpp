// Work-group sizes, formats of nodes and drivers of paths: they change the time and nothing else, and the
// searches keep what they found.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "check/ray_caster.h"
#include "device_fixture.h"
#include "own_cache.h"
#include "trace/path_driver.h"
#include "trace/tune.h"

using namespace triad;
using namespace triad::traversal_case;

namespace {

/// Puts the device's choices back, and keeps the user's cache out of the test.
class Tune : public ::testing::Test {
  protected:
    ~Tune() override {
        test_device().set_preferred_local(local_);
        set_format(test_device(), format_);
        set_path_driver(test_device(), path_driver_);
    }

  private:
    std::size_t local_ = test_device().preferred_local();
    BvhFormat format_ = format_of(test_device());
    PathDriverKind path_driver_ = path_driver_of(test_device());
    OwnCache cache_;
};

const TuneSearch& search_of(const std::string& name) {
    for (const TuneSearch& search : tune_searches())
        if (search.name == name) return search;
    throw std::runtime_error("no search " + name);
}

std::vector<TuneTiming> rays_and_paths(double mega, double wave) {
    return {{"rays", {{"format", "bvh8"}, {"local", "64"}}, 1.0},
            {"paths", {{"path_driver", "mega"}, {"batch", "0"}}, mega},
            {"paths", {{"path_driver", "wave"}, {"batch", "0"}}, wave}};
}

/// A search of two values on each of two axes, whose "b" is known with "big" alone. The workload takes as
/// many seconds as the values have letters, and refuses what is named `refused`.
std::string refused;
class Letters : public Workload {
  public:
    explicit Letters(Device& device) : choices_(device.choices()) {}
    double seconds() override {
        if (refused == "all" || choices_.at("size") == refused)
            throw DeviceError(Exit::device, -54, "refused");
        return double((choices_.at("size") + choices_.at("letter")).size());
    }

  private:
    std::map<std::string, std::string>& choices_;
};
const TuneSearch letters{
    "letters",
    TuneWhen::asked,
    {{"size",
      [](const Device&) {
          return std::vector<std::string>{"big", "little"};
      },
      [](const std::string&) { return true; },
      [](Device& device, const std::string& value) { device.choices()["size"] = value; }},
     {"letter",
      [](const Device& device) {
          return device.choices().at("size") == "big" ? std::vector<std::string>{"a", "bb"}
                                                      : std::vector<std::string>{"a"};
      },
      [](const std::string&) { return true; },
      [](Device& device, const std::string& value) { device.choices()["letter"] = value; }}},
    [](Device& device) -> std::unique_ptr<Workload> { return std::make_unique<Letters>(device); }};

TEST_F(Tune, the_work_group_size_changes_no_bit) {
    World world;
    world.origin_reach = 2.0f;
    world.add(0, shapes::displaced_sphere(vec3(0.0f), 1.0f, 40, 30, 0.3f, 3.0f, 1));
    const RayCaster caster(test_device(), world);
    Random random(1);
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 5000; ++i) rays.push_back(ray(random.in_cube(0.5), random.direction()));
    test_device().set_preferred_local(64);
    const auto expected = caster.closest(rays);
    for (const std::size_t local : {1u, 8u}) {
        test_device().set_preferred_local(local);
        const auto hits = caster.closest(rays);
        EXPECT_EQ(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(dev::Hit)), 0) << local;
    }
}

TEST_F(Tune, keeps_what_is_fastest_and_measures_once) {
    Device& device = test_device();
    ASSERT_FALSE(load_timings(device.info()));
    const Tuning found = ensure_tuned(device);
    const auto timings = load_timings(device.info());
    ASSERT_TRUE(timings);
    EXPECT_GE(timings->size(), 2u) << "both formats at least";
    for (const auto& [name, value] : best_of(*timings)) EXPECT_EQ(found.at(name), value);
    for (const TuneTiming& timing : *timings)
        EXPECT_EQ(timing.search, "rays") << "a first use compiles no driver of paths that it may never need";
    EXPECT_EQ(found.at("path_driver"), name_of(default_path_driver(device.info()))) << "not measured";
    EXPECT_EQ(name_of(format_of(device)), found.at("format"));
    EXPECT_EQ(std::to_string(device.preferred_local()), found.at("local"));
    auto others = *timings;
    for (TuneTiming& timing : others) timing.seconds = timing.values == best_of(*timings) ? 2.0 : 1.0;
    keep_timings(device.info(), others);
    EXPECT_NE(ensure_tuned(device), found) << "what is kept is used, not measured again";
}

TEST_F(Tune, a_wish_is_granted_with_what_is_best_beside_it) {
    Device& device = test_device();
    const Tuning best = ensure_tuned(device);
    for (const BvhFormat format : all_bvh_formats) {
        EXPECT_EQ(ensure_tuned(device, {{"format", name_of(format)}}).at("format"), name_of(format));
        EXPECT_EQ(format_of(device), format);
    }
    EXPECT_EQ(ensure_tuned(device), best);
    EXPECT_THROW(ensure_tuned(device, {{"format", "none"}}), Error);
}

TEST_F(Tune, times_every_driver_of_paths) {
    Device& device = test_device();
    const auto timings = time_search(device, search_of("paths"));
    std::map<std::string, std::set<std::string>> batches;
    for (const TuneTiming& timing : timings) {
        batches[timing.values.at("path_driver")].insert(timing.values.at("batch"));
        EXPECT_GT(timing.seconds, 1e-3) << "too short to tell";
        EXPECT_LT(timing.seconds, 60.0);
    }
    EXPECT_EQ(batches.at("mega"), std::set<std::string>{"0"});
    EXPECT_EQ(batches.contains("wave"), device.info().type == "cpu");
    EXPECT_EQ(batches.at("wave-stages").size(), 3u);
}

TEST_F(Tune, the_driver_of_paths_is_what_was_measured_unless_one_is_wished_for) {
    Device& device = test_device();
    keep_timings(device.info(), rays_and_paths(2.0, 1.0));
    EXPECT_EQ(ensure_tuned(device).at("path_driver"), "wave");
    EXPECT_EQ(path_driver_of(device), PathDriverKind::wave);
    EXPECT_EQ(ensure_tuned(device, {{"path_driver", "mega"}}).at("path_driver"), "mega");
    EXPECT_EQ(path_driver_of(device), PathDriverKind::mega);
    keep_timings(device.info(), rays_and_paths(1.0, 0.97));
    EXPECT_EQ(ensure_tuned(device).at("path_driver"), "mega") << "not clearly faster";
}

TEST_F(Tune, without_a_measurement_the_driver_of_paths_is_mega_unless_one_is_wished_for) {
    Device& device = test_device();
    keep_timings(device.info(), {rays_and_paths(1.0, 1.0).front()});
    EXPECT_EQ(ensure_tuned(device, {{"path_driver", "wave"}}).at("path_driver"), "wave");
    EXPECT_EQ(path_driver_of(device), PathDriverKind::wave);
    EXPECT_EQ(ensure_tuned(device).at("path_driver"), "mega");
    EXPECT_EQ(path_driver_of(device), PathDriverKind::mega);
    EXPECT_THROW(ensure_tuned(device, {{"path_driver", "none"}}), Error);
}

TEST_F(Tune, timings_without_an_axis_of_today_are_left_out) {
    const DeviceInfo& info = test_device().info();
    auto timings = rays_and_paths(2.0, 1.0);
    for (TuneTiming& timing : timings)
        if (timing.search == "paths") timing.values = {{"before", "1"}};
    timings.push_back({"no such search", {{"before", "1"}}, 1.0});
    keep_timings(info, timings);
    ASSERT_TRUE(load_timings(info)) << "what a first use measures is there";
    EXPECT_EQ(load_timings(info)->size(), 1u);
}

TEST_F(Tune, values_that_an_axis_does_not_know_are_measured_again) {
    Device& device = test_device();
    for (const Tuning& damaged :
         {Tuning{{"format", "x"}, {"local", "64"}}, Tuning{{"format", "bvh8"}, {"local", ""}},
          Tuning{{"format", "bvh8"}, {"local", "-1"}},
          Tuning{{"format", "bvh8"}, {"local", "99999999999999999999"}}}) {
        keep_timings(device.info(), {{"rays", damaged, 1e-9}});
        EXPECT_FALSE(load_timings(device.info()));
        EXPECT_NO_THROW(ensure_tuned(device));
    }
}

TEST_F(Tune, values_of_an_axis_may_depend_on_those_before_it) {
    refused = "";
    const auto timings = time_search(test_device(), letters);
    ASSERT_EQ(timings.size(), 3u);
    EXPECT_EQ(timings[0].values, (Tuning{{"size", "big"}, {"letter", "a"}}));
    EXPECT_EQ(timings[1].values, (Tuning{{"size", "big"}, {"letter", "bb"}}));
    EXPECT_EQ(timings[2].values, (Tuning{{"size", "little"}, {"letter", "a"}}));
    EXPECT_EQ(timings[1].seconds, 5.0);
}

TEST_F(Tune, what_a_device_refuses_is_not_chosen) {
    refused = "big";
    const auto timings = time_search(test_device(), letters);
    ASSERT_EQ(timings.size(), 1u);
    EXPECT_EQ(best_of(timings).at("size"), "little");
    refused = "all";
    EXPECT_THROW(time_search(test_device(), letters), DeviceError);
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
    two.push_back({"paths", {{"path_driver", "mega"}}, 3.0});
    two.push_back({"paths", {{"path_driver", "wave"}}, 1.0});
    EXPECT_EQ(best_of(two), (Tuning{{"format", "b"}, {"local", "8"}, {"path_driver", "wave"}}));
}

}  // namespace
