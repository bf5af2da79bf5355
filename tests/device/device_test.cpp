// The layer over OpenCL: memory, programs, launches, and what its errors say.
#include <gtest/gtest.h>

#include <numeric>

#include "device_fixture.h"

using namespace triad;

namespace {

const char* const add_source = R"(#include "common/language.h"
__kernel void add_to(__global uint* values, __global const uint* optional, uint amount, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    values[i] += amount + (optional ? optional[i] : 0u);
}
)";

TEST(Device, runs_a_kernel_over_a_count_that_is_no_multiple_of_the_group) {
    Device& device = test_device();
    std::vector<std::uint32_t> values(1001);
    std::iota(values.begin(), values.end(), 0u);
    const Buffer buffer = device.upload(values);
    const Kernel kernel = device.build_source("add.cl", add_source).kernel("add_to");
    const Arguments arguments =
        Arguments().add(buffer).add(Buffer{}).add(std::uint32_t(7)).add(std::uint32_t(1001));
    device.run(kernel, arguments, values.size());
    device.run(kernel, arguments, values.size(), 16);
    device.finish();
    const auto result = device.download<std::uint32_t>(buffer);
    for (std::uint32_t i = 0; i < result.size(); ++i) ASSERT_EQ(result[i], i + 14);
}

TEST(Device, passes_an_optional_buffer) {
    Device& device = test_device();
    const std::vector<std::uint32_t> zeros(64), threes(64, 3);
    const Buffer values = device.upload(zeros), others = device.upload(threes);
    device.run(device.build_source("add.cl", add_source).kernel("add_to"),
               Arguments().add(values).add(others).add(std::uint32_t(1)).add(std::uint32_t(64)), 64);
    for (std::uint32_t value : device.download<std::uint32_t>(values)) ASSERT_EQ(value, 4u);
}

TEST(Device, writes_reads_and_clears_parts) {
    Device& device = test_device();
    const Buffer buffer = device.allocate(16);
    device.fill_zero(buffer);
    const std::uint32_t five = 5;
    device.write(buffer, &five, sizeof five, 8);
    EXPECT_EQ(device.download<std::uint32_t>(buffer), (std::vector<std::uint32_t>{0, 0, 5, 0}));
    std::uint32_t back = 0;
    device.read(buffer, &back, sizeof back, 8);
    EXPECT_EQ(back, 5u);
}

}  // namespace
