// The layer over OpenCL: memory, launches, programs, and what its errors say.
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

Kernel add_kernel(Device& device) { return device.build_source("add.cl", add_source).kernel("add_to"); }

/// What `call` throws, or a failure.
template <class Call>
DeviceError error_of(Call call) {
    try {
        call();
    } catch (const DeviceError& error) {
        return error;
    }
    ADD_FAILURE() << "no DeviceError";
    return {Exit::done, 0, ""};
}

bool says(const std::exception& error, const std::string& part) {
    return std::string(error.what()).find(part) != std::string::npos;
}

TEST(Device, runs_a_count_that_is_no_multiple_of_the_group) {
    Device& device = test_device();
    std::vector<std::uint32_t> values(1001);
    std::iota(values.begin(), values.end(), 0u);
    const Buffer buffer = device.upload(values);
    const Kernel kernel = add_kernel(device);
    const Arguments arguments =
        Arguments().add(buffer).add(Buffer{}).add(std::uint32_t(7)).add(std::uint32_t(1001));
    device.run(kernel, arguments, values.size());
    device.run(kernel, arguments, values.size(), 16);
    device.run(kernel, arguments, 0);
    device.finish();
    const auto result = device.download<std::uint32_t>(buffer);
    for (std::uint32_t i = 0; i < result.size(); ++i) ASSERT_EQ(result[i], i + 14);
}

TEST(Device, passes_an_optional_buffer) {
    Device& device = test_device();
    const Buffer values = device.upload(std::vector<std::uint32_t>(64, 0));
    const Buffer others = device.upload(std::vector<std::uint32_t>(64, 3));
    device.run(add_kernel(device),
               Arguments().add(values).add(others).add(std::uint32_t(1)).add(std::uint32_t(64)), 64);
    for (std::uint32_t value : device.download<std::uint32_t>(values)) ASSERT_EQ(value, 4u);
}

TEST(Device, keeps_arguments_alive_until_the_launch) {
    Device& device = test_device();
    const Buffer values = device.upload(std::vector<std::uint32_t>(64, 0));
    Arguments arguments = Arguments().add(values);
    arguments.add(device.upload(std::vector<std::uint32_t>(64, 5)));
    arguments.add(Arguments().add(std::uint32_t(1)).add(std::uint32_t(64)));
    device.run(add_kernel(device), arguments, 64);
    for (std::uint32_t value : device.download<std::uint32_t>(values)) ASSERT_EQ(value, 6u);
}

TEST(Device, writes_reads_and_clears_parts) {
    Device& device = test_device();
    const Buffer buffer = device.upload(std::vector<std::uint32_t>(4, 9));
    device.fill_zero(buffer);
    const std::uint32_t five = 5;
    device.write(buffer, &five, sizeof five, 8);
    EXPECT_EQ(device.download<std::uint32_t>(buffer), (std::vector<std::uint32_t>{0, 0, 5, 0}));
    std::uint32_t back = 0;
    device.read(buffer, &back, sizeof back, 8);
    EXPECT_EQ(back, 5u);
    EXPECT_FALSE(device.upload(std::vector<float>{}));
    EXPECT_FALSE(device.allocate(0));
}

TEST(Device, builds_equal_text_and_options_once) {
    Device device = Device::open({.selector = std::to_string(test_device().info().index)});
    const std::string source = "__kernel void once(__global uint* out) { out[0] = VALUE; }";
    device.build_source("once.cl", source, {{"VALUE", "1"}});
    const double before = device.compile_seconds();
    const Program again = device.build_source("once.cl", source, {{"VALUE", "1"}});
    EXPECT_EQ(device.compile_seconds(), before);
    const Program other = device.build_source("once.cl", source, {{"VALUE", "2"}});
    EXPECT_GT(device.compile_seconds(), before);
    const Buffer out = device.allocate(4);
    for (const auto& [program, value] : {std::pair(again, 1u), std::pair(other, 2u)}) {
        device.run(program.kernel("once"), Arguments().add(out), 1, 1);
        EXPECT_EQ(device.download<std::uint32_t>(out).front(), value);
    }
}

TEST(Device, times_kernels_on_request_only) {
    Device profiled = Device::open({.selector = std::to_string(test_device().info().index), .profile = true});
    const Buffer values = profiled.upload(std::vector<std::uint32_t>(64, 0));
    const Arguments arguments =
        Arguments().add(values).add(Buffer{}).add(std::uint32_t(1)).add(std::uint32_t(64));
    for (int i = 0; i < 3; ++i) profiled.run(add_kernel(profiled), arguments, 64);
    std::size_t launches = 0;
    for (const DeviceCommand& command : profiled.commands()) {
        if (command.kind != CommandKind::kernel) continue;
        ++launches;
        EXPECT_EQ(command.name, "add_to");
        EXPECT_GT(command.end, command.start);
    }
    EXPECT_EQ(launches, 3u);
    EXPECT_TRUE(test_device().commands().empty());
}

// How busy the threads are is not asked: a driver may wait for its worker by spinning, or let the waiting
// thread help.
TEST(Device, holds_a_cpu_to_one_compute_unit) {
    const DeviceInfo& whole = test_device().info();
    Device part = Device::open({.selector = std::to_string(whole.index), .threads = 1});
    EXPECT_EQ(part.info().compute_units, whole.type == "cpu" ? 1u : whole.compute_units);
    const Buffer values = part.upload(std::vector<std::uint32_t>(256, 1));
    part.run(add_kernel(part),
             Arguments().add(values).add(Buffer{}).add(std::uint32_t(41)).add(std::uint32_t(256)), 256);
    EXPECT_EQ(part.download<std::uint32_t>(values), std::vector<std::uint32_t>(256, 42));
}

TEST(DeviceError, of_a_broken_program_names_our_file_and_line) {
    Device& device = test_device();
    const DeviceError error = error_of([&] {
        device.build_source("broken.cl",
                            "#include \"common/language.h\"\n"
                            "__kernel void broken(__global uint* out) {\n"
                            "    out[0] = undeclared_name;\n"
                            "}\n",
                            {{"SOME_OPTION", "1"}});
    });
    EXPECT_EQ(error.exit(), Exit::device);
    EXPECT_EQ(error.code(), -11);
    for (const std::string& part :
         {std::string("clBuildProgram"), std::string("CL_BUILD_PROGRAM_FAILURE (-11)"), device.info().name,
          device.info().driver, std::string("program broken.cl"), std::string("-D SOME_OPTION=1"),
          std::string("kernels/broken.cl:3"), std::string("undeclared_name")})
        EXPECT_TRUE(says(error, part)) << part << " is missing in: " << error.what();
}

TEST(DeviceError, names_a_missing_kernel) {
    const Program program = test_device().build_source("add.cl", add_source);
    const DeviceError error = error_of([&] { program.kernel("subtract"); });
    EXPECT_TRUE(says(error, "Program add.cl has no kernel subtract.")) << error.what();
}

TEST(DeviceError, of_arguments_that_do_not_fit_the_kernel) {
    Device& device = test_device();
    const Kernel kernel = add_kernel(device);
    const Buffer buffer = device.allocate(256);
    // A launch with all arguments first: the kernel object remembers them.
    device.run(kernel, Arguments().add(buffer).add(Buffer{}).add(std::uint32_t(1)).add(std::uint32_t(1)), 1);
    const DeviceError few = error_of([&] { device.run(kernel, Arguments().add(buffer).add(Buffer{}), 1); });
    EXPECT_TRUE(says(few, "takes 4 arguments, not 2")) << few.what();
    const DeviceError wide = error_of(
        [&] { device.run(kernel, Arguments().add(buffer).add(Buffer{}).add(1.0).add(std::uint32_t(1)), 1); });
    EXPECT_TRUE(says(wide, "Argument 2 of kernel add_to")) << wide.what();
}

TEST(DeviceError, of_too_large_a_group_leaves_the_device_usable) {
    Device& device = test_device();
    const Kernel kernel = add_kernel(device);
    const Buffer buffer = device.allocate(256);
    const Arguments arguments =
        Arguments().add(buffer).add(Buffer{}).add(std::uint32_t(1)).add(std::uint32_t(1));
    const DeviceError error =
        error_of([&] { device.run(kernel, arguments, 1, device.info().max_work_group + 1); });
    EXPECT_EQ(error.code(), -54);
    EXPECT_NO_THROW(device.run(kernel, arguments, 1));
    EXPECT_NO_THROW(device.finish());
}

TEST(DeviceError, of_too_large_a_buffer_means_memory_and_the_device_stays_usable) {
    Device& device = test_device();
    const std::uint64_t most = device.info().max_allocation;
    ASSERT_GT(most, 0u);
    const DeviceError error = error_of([&] { device.allocate(most + 1); });
    EXPECT_EQ(error.exit(), Exit::memory);
    EXPECT_TRUE(says(error, "Out of device memory")) << error.what();
    EXPECT_TRUE(device.allocate(64));
}

}  // namespace
