#include "replay/replay_profile.h"

#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

#include "base/log.h"
#include "base/text.h"
#include "profile/work_json.h"
#include "replay/captured_shape.h"

namespace triad {
namespace {

/// Some drivers stamp the events of all launches with the same time.
constexpr double least_share_of_events = 0.01;

double samples_of(const Capture& capture) {
    double samples = 0;
    for (const CapturedArray& array : capture.film) {
        if (array.what != CapturedArray::What::samples) continue;
        std::vector<std::uint32_t> each(array.content->size() / sizeof(std::uint32_t));
        std::memcpy(each.data(), array.content->data(), each.size() * sizeof(std::uint32_t));
        samples = std::accumulate(each.begin(), each.end(), samples);
    }
    return samples;
}

double items_of(const Replayer& replayer, const std::string& kernel) {
    double items = 0;
    for (const std::size_t place : replayer.launches_of(kernel))
        items += double(std::get<Recording::Launch>(replayer.capture().work.commands[place]).items);
    return items;
}

Profile profile_of(const Replayer& replayer, std::vector<ReplayedRun> runs) {
    Device& device = replayer.device();
    const Capture& capture = replayer.capture();
    Profile p;
    p.device = device.info();
    p.format = name_of(captured_format(capture.work)), p.path_driver = name_of(captured_driver(capture.work));
    p.samples = samples_of(capture);
    std::vector<std::vector<DeviceCommand>> commands;
    double events = 0, seconds = 0;
    for (ReplayedRun& run : runs) {
        for (const DeviceCommand& command : run.commands)
            events += 1e-9 * double(command.end - command.start);
        seconds += run.seconds;
        p.seconds_of_runs.push_back(run.seconds);
        commands.push_back(std::move(run.commands));
    }
    if (events < least_share_of_events * seconds)
        warn(format(
            "The driver's profiling events add up to %.3g of the %.3g ms that the runs take: it does not "
            "time launches, and the rows say nothing.",
            1e3 * events, 1e3 * seconds));
    std::uint64_t bytes = 0;
    for (const Recording::Memory& memory : capture.work.memories) bytes += memory.bytes;
    p.memory = {{std::to_string(capture.work.memories.size()) + " buffers", bytes}};
    p.compilations = device.compilations();
    add_commands(p, commands, device.kernels());
    return p;
}

}  // namespace

Profile profile_of(Replayer& replayer, unsigned runs, const LocalSizes& sizes) {
    std::vector<ReplayedRun> all;
    for (unsigned i = 0; i < runs; ++i) all.push_back(replayer.run(sizes));
    return profile_of(replayer, std::move(all));
}

Profile profile_alone(Replayer& replayer, std::size_t place, unsigned times) {
    Profile p = profile_of(replayer, replayer.repeat(place, times));
    const auto& launch = std::get<Recording::Launch>(replayer.capture().work.commands[place]);
    // Its part of what all launches of the kernel do together.
    p.samples *= double(launch.items) / items_of(replayer, replayer.kernel_of(launch));
    return p;
}

std::optional<WorkCounts> counted_work(const Capture& capture) {
    if (capture.counted.empty()) return {};
    return work_counts_of(capture.counted);
}

}  // namespace triad
