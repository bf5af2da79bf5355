// What a device can do at most: numbers that a roof can be made of.
#include <gtest/gtest.h>

#include <string>

#include "device_fixture.h"
#include "profile/device_peaks.h"

using namespace triad;

TEST(DevicePeaks, are_what_no_cache_and_no_compiler_makes_up) {
    Device device = Device::open({.selector = std::to_string(test_device().info().index), .profile = true});
    const DevicePeaks peaks = measure_peaks(device);
    // Below what any device of this century does, and beyond what one could: work that was left out.
    EXPECT_GT(peaks.flops, 1e8);
    EXPECT_LT(peaks.flops, 1e15);
    ASSERT_FALSE(peaks.memory.empty());
    for (const MemoryPeak& peak : peaks.memory) {
        EXPECT_GT(peak.read, 1e8) << peak.bytes;
        EXPECT_LT(peak.read, 1e14) << peak.bytes;
        EXPECT_GT(peak.copy, 1e8) << peak.bytes;
        EXPECT_GT(peak.gathers, 1e5) << peak.bytes;
        EXPECT_LT(peak.gathers, peaks.flops) << peak.bytes;
    }
    // A walk through memory waits longer than one through a cache.
    EXPECT_LT(peaks.memory.back().gathers, peaks.memory.front().gathers);
}

TEST(DeviceCommands, know_what_was_done_in_order) {
    Device device = Device::open({.selector = std::to_string(test_device().info().index), .profile = true});
    const Buffer buffer = device.allocate(4096);
    device.fill_zero(buffer);
    const Kernel kernel =
        device.build_source("count.cl", "kernel void add_one(global uint* a) { a[get_global_id(0)] += 1u; }")
            .kernel("add_one");
    device.run(kernel, Arguments().add(buffer), 1024);
    EXPECT_EQ(device.download<std::uint32_t>(buffer), std::vector<std::uint32_t>(1024, 1));
    const std::vector<DeviceCommand>& commands = device.commands();
    ASSERT_EQ(commands.size(), 3u);
    EXPECT_EQ(commands[0].kind, CommandKind::fill);
    EXPECT_EQ(commands[0].bytes, 4096u);
    EXPECT_EQ(commands[1].name, "add_one");
    EXPECT_EQ(commands[1].items, 1024u);
    EXPECT_EQ(commands[2].kind, CommandKind::read);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(commands[i].queued, commands[i].start);
        EXPECT_LE(commands[i].start, commands[i].end);
        if (i > 0) {
            EXPECT_LE(commands[i - 1].end, commands[i].start);
        }
    }
    ASSERT_FALSE(device.kernels().empty());
    EXPECT_EQ(device.kernels().front().name, "add_one");
    EXPECT_EQ(device.compilations().size(), 1u);
}
