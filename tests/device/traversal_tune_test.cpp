// Work-group sizes: they change the time and nothing else, and the search keeps what it found.
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
        old_cache_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", old_cache_.c_str(), 1);
        std::filesystem::remove_all(folder_);
    }

  private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("triad-tune-" + std::to_string(getpid()));
    std::string old_cache_;
    std::size_t local_ = test_device().preferred_local();
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

TEST_F(TraversalTune, keeps_the_fastest_size_and_measures_once) {
    Device& device = test_device();
    ASSERT_FALSE(load_tuned_local(device.info()).has_value());
    const std::size_t found = ensure_tuned(device);
    EXPECT_EQ(device.preferred_local(), found);
    EXPECT_EQ(load_tuned_local(device.info()), found);
    const std::size_t other = found == 8 ? 4 : 8;
    store_tuned_local(device.info(), other);
    EXPECT_EQ(ensure_tuned(device), other) << "what is kept is used, not measured again";
    EXPECT_EQ(device.preferred_local(), other);
}

}  // namespace
