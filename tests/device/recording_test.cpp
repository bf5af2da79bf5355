// What a device is told to do is noted with all that it needs to be done again.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "capture/capture.h"
#include "device/recording.h"
#include "device_fixture.h"
#include "replay/replayer.h"

namespace triad {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers numbers_of(const AlignedVector<std::byte>& bytes) {
    Numbers numbers(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

/// x = 2 x + y + plus, for eight numbers; two launches with a write and a fill between.
struct RecordedNumbers {
    Capture capture;
    Numbers first, last;  ///< x after the first launch, and at the end

    RecordedNumbers() {
        Device& device = test_device();
        const Kernel kernel =
            device
                .build_source(
                    "tests/double.cl",
                    "kernel void double_add(global uint* x, global const uint* y, uint plus, global "
                    "uint* none) {\n"
                    "    const size_t i = get_global_id(0);\n"
                    "    if (i < 8u && !none) x[i] = 2u * x[i] + y[i] + plus;\n"
                    "}\n")
                .kernel("double_add");
        const auto x = device.upload(Numbers{1, 2, 3, 4, 5, 6, 7, 8});
        const auto y = device.upload(Numbers{10, 20, 30, 40, 50, 60, 70, 80});
        const Buffer z = device.allocate(32);
        device.fill_zero(x);  // before recording: the replay begins with what this left
        device.record(&capture.work);
        const auto run = [&](const Buffer& added, std::uint32_t plus) {
            device.run(kernel, Arguments().add(x).add(added).add(plus).add(Buffer{}), 8);
        };
        run(y, 3);
        first = device.download<std::uint32_t>(x);
        const std::uint32_t ones[2] = {1, 1};
        device.write(y, ones, sizeof ones, 8);
        device.fill_zero(z);
        run(y, 0);
        run(z, 100);
        last = device.download<std::uint32_t>(x);
        AlignedVector<std::byte> bytes(32);
        device.read(x, bytes.data(), bytes.size());
        capture.film = {{CapturedArray::What::sums, device.recorded(x).value(), 0, 1,
                         std::make_shared<const AlignedVector<std::byte>>(std::move(bytes))}};
        EXPECT_FALSE(device.recorded(device.allocate(4)).has_value());
        device.record(nullptr);
        run(y, 7);  // not noted any more
    }
};

TEST(Recording, notes_each_thing_once_with_what_it_held) {
    const RecordedNumbers recorded;
    const Recording& work = recorded.capture.work;
    EXPECT_EQ(work.sources.size(), 1u);
    EXPECT_EQ(work.functions.size(), 1u);
    EXPECT_EQ(work.memories.size(), 3u);
    EXPECT_EQ(work.argument_lists.size(), 3u);
    EXPECT_EQ(work.commands.size(), 5u);
    EXPECT_EQ(numbers_of(*work.memories[0].content), Numbers(8));
    EXPECT_EQ(numbers_of(*work.memories[1].content)[2], 30u);  // as it was before it was written
    EXPECT_EQ(work.memories[2].content, nullptr);              // filled before it is read
    EXPECT_EQ(recorded.first[7], 83u);                         // 2 * 0 + 80 + 3
    EXPECT_EQ(recorded.last, (Numbers{172, 232, 234, 274, 412, 472, 532, 592}));
}

TEST(Recording, a_replay_does_it_again_as_often_as_one_likes) {
    const RecordedNumbers recorded;
    Replayer replayer(test_device(), recorded.capture);
    for (int i = 0; i < 3; ++i) {
        replayer.run();
        EXPECT_EQ(numbers_of(replayer.film()[0]), recorded.last);
    }
}

TEST(Recording, a_launch_alone_begins_each_time_with_what_came_before_it) {
    const RecordedNumbers recorded;
    Replayer replayer(test_device(), recorded.capture);
    const std::vector<std::size_t> launches = replayer.launches_of("double_add");
    ASSERT_EQ(launches.size(), 3u);
    EXPECT_TRUE(replayer.launches_of("nothing").empty());
    replayer.repeat(launches[0], 4);
    EXPECT_EQ(numbers_of(replayer.film()[0]), recorded.first);
    replayer.repeat(launches[2], 4);
    EXPECT_EQ(numbers_of(replayer.film()[0]), recorded.last);
}

}  // namespace
}  // namespace triad
