// What is kept between runs: compiled programs and tuned work-group sizes. And how a device is selected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "base/hash.h"
#include "device_fixture.h"
#include "own_cache.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

class Cache : public testing::Test {
  protected:
    Device& device = test_device();  // open before the cache is another
    const OwnCache cache;
    std::vector<fs::path> programs() const { return cache.files("programs"); }
    static Device again() { return Device::open({.selector = std::to_string(test_device().info().index)}); }
    static std::uint32_t answer(const std::string& value = "42") {
        Device device = again();
        const Buffer out = device.allocate(sizeof(std::uint32_t));
        const Program program = device.build_source(
            "answer.cl", "__kernel void answer(__global uint* out) { out[0] = VALUE; }", {{"VALUE", value}});
        device.run(program.kernel("answer"), Arguments().add(out), 1, 1);
        return device.download<std::uint32_t>(out).front();
    }
};

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<TuneTiming> some_timings() {
    return {{"rays", {{"format", "bvh8"}, {"local", "64"}}, 1.0},
            {"rays", {{"format", "bvh4"}, {"local", "8"}}, 0.5}};
}

TEST_F(Cache, holds_one_entry_per_text_and_options_unless_the_driver_keeps_its_own) {
    EXPECT_EQ(answer(), 42u);
    const std::size_t each = test_device().info().platform == "Portable Computing Language" ? 0 : 1;
    EXPECT_EQ(programs().size(), each);
    EXPECT_EQ(answer(), 42u);
    EXPECT_EQ(programs().size(), each);
    EXPECT_EQ(answer("43"), 43u);
    EXPECT_EQ(programs().size(), 2 * each);
}

TEST_F(Cache, holds_one_entry_per_setting_of_the_driver) {
    const char* const mode = "CL_CONFIG_CPU_VECTORIZER_MODE";  // of Intel's; no other driver has settings
    const std::size_t more = test_device().info().settings.empty() ? 0 : 1;
    const char* const value = std::getenv(mode);
    const std::string kept = value ? value : "1";
    EXPECT_EQ(answer(), 42u);
    const std::size_t before_it = programs().size();
    ::setenv(mode, kept == "4" ? "8" : "4", 1);
    EXPECT_EQ(answer(), 42u);
    ::setenv(mode, kept.c_str(), 1);
    EXPECT_EQ(programs().size(), before_it + more);
}

TEST_F(Cache, survives_damaged_entries_and_mends_them) {
    EXPECT_EQ(answer(), 42u);
    for (const fs::path& path : programs()) {
        const std::string good = contents(path);
        std::string flipped = good;
        flipped[flipped.size() / 2] ^= 1;
        for (const std::string& bad :
             {std::string(), good.substr(0, 20), good.substr(0, good.size() / 2), flipped}) {
            std::ofstream(path, std::ios::binary) << bad;
            EXPECT_EQ(answer(), 42u);
            EXPECT_NE(contents(path), bad) << "not rebuilt";  // its size may differ: Intel's do
        }
    }
}

TEST_F(Cache, that_cannot_be_written_is_a_temporary_one_of_this_process) {
    std::ofstream(cache.folder() / "triad") << "a file where the folder should be";
    EXPECT_EQ(answer(), 42u);
    EXPECT_FALSE(load_timings(test_device().info()));
    keep_timings(test_device().info(), some_timings());
    EXPECT_TRUE(load_timings(test_device().info()));
}

TEST_F(Cache, keeps_what_was_tuned_per_device_and_driver) {
    const DeviceInfo& info = test_device().info();
    EXPECT_FALSE(load_timings(info));
    keep_timings(info, some_timings());
    ASSERT_TRUE(load_timings(info));
    EXPECT_EQ(best_of(*load_timings(info)), (Tuning{{"format", "bvh4"}, {"local", "8"}}));
    DeviceInfo other = info;
    other.driver += " next";
    EXPECT_FALSE(load_timings(other));
    for (const char* bad :
         {"", "{", "[]", "{\"schema\": \"triad.tuned/1\", \"local\": 8}", "{\"schema\": 3, \"timings\": []}",
          "{\"schema\": \"triad.tuned/2\", \"timings\": []}",
          "{\"schema\": \"triad.tuned/2\", \"timings\": [1]}",
          "{\"schema\": \"triad.tuned/2\", \"timings\": [{\"search\": \"rays\", \"seconds\": 1, \"values\": "
          "{\"local\": "
          "\"8\"}}]}"}) {
        for (const fs::path& path : cache.files("tuned")) std::ofstream(path) << bad;
        EXPECT_FALSE(load_timings(info)) << bad;
    }
}

TEST(Selection, by_index_type_and_part_of_a_name_in_any_case) {
    const DeviceInfo& info = test_device().info();
    std::string upper = info.name;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(Device::open({.selector = std::to_string(info.index)}).info().index, info.index);
    EXPECT_EQ(Device::open({.selector = upper}).info().name, info.name);
    EXPECT_EQ(Device::open({.selector = info.platform.substr(1)}).info().platform, info.platform);
    if (info.type != "other") {
        EXPECT_EQ(Device::open({.selector = info.type}).info().type, info.type);
    }
}

TEST(Selection, prefers_exactly_one_device_and_opens_it) {
    const DeviceList list = list_devices();
    std::vector<std::size_t> preferred;
    for (const DeviceInfo& each : list.devices)
        if (each.preferred) preferred.push_back(each.index);
    ASSERT_EQ(preferred.size(), 1u);
    EXPECT_EQ(Device::open({}).info().index, preferred.front());
}

TEST(Selection, of_nothing_lists_what_there_is) {
    try {
        Device::open({.selector = "no such device"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::usage);
        EXPECT_NE(std::string(error.what()).find(test_device().info().name), std::string::npos)
            << error.what();
    }
}

}  // namespace
