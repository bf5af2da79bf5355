#include "replay/replayer.h"

#include <chrono>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <variant>

namespace triad {
namespace {

/// What the capture's device was best at suits others of its kind.
std::size_t first_local(const Device& device, const CaptureOrigin& origin) {
    return device.info().type == origin.type && origin.local > 0 ? origin.local : device.preferred_local();
}

}  // namespace

Replayer::Replayer(Device& device, const Capture& capture)
    : device_(device), capture_(capture), local_(first_local(device, capture.origin)) {
    const Recording& work = capture.work;
    std::vector<Program> programs;
    for (const Recording::Source& source : work.sources)
        programs.push_back(device.build_flattened(source.path, source.text, source.options));
    for (const Recording::Function& function : work.functions)
        kernels_.push_back(programs[function.source].kernel(function.name));
    for (const Recording::Memory& memory : work.memories) {
        if (memory.read_only && memory.content)
            buffers_.push_back(device.share(std::span<const std::byte>(*memory.content), memory.content));
        else
            buffers_.push_back(device.allocate(memory.bytes));
    }
    for (const auto& list : work.argument_lists) {
        Arguments& arguments = arguments_.emplace_back();
        for (const Recording::Argument& argument : list) {
            if (const auto* place = std::get_if<std::size_t>(&argument))
                arguments.add(buffers_[*place]);
            else if (const auto* bytes = std::get_if<std::string>(&argument))
                arguments.add_bytes(bytes->data(), bytes->size());
            else
                arguments.add(Buffer{});
        }
    }
}

void Replayer::restore() {
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const Recording::Memory& memory = capture_.work.memories[i];
        if (memory.content && !memory.read_only)
            device_.write(buffers_[i], memory.content->data(), memory.bytes);
    }
}

void Replayer::enqueue(const Recording::Command& command, const LocalSizes& sizes) {
    if (const auto* write = std::get_if<Recording::Write>(&command)) {
        device_.write(buffers_[write->memory], write->content->data(), write->content->size(), write->offset);
    } else if (const auto* fill = std::get_if<Recording::FillZero>(&command)) {
        device_.fill_zero(buffers_[fill->memory]);
    } else {
        const auto& launch = std::get<Recording::Launch>(command);
        const auto size = sizes.find(kernel_of(launch));
        device_.set_preferred_local(size == sizes.end() ? local_ : size->second);
        device_.run(kernels_[launch.function], arguments_[launch.arguments], launch.items, launch.local);
    }
}

ReplayedRun Replayer::timed(const std::function<void()>& enqueue) {
    device_.finish();
    const std::size_t before = device_.commands().size();
    const auto start = std::chrono::steady_clock::now();
    enqueue();
    device_.finish();
    ReplayedRun run;
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::vector<DeviceCommand>& all = device_.commands();
    run.commands.assign(all.begin() + std::ptrdiff_t(before), all.end());
    return run;
}

ReplayedRun Replayer::run(const LocalSizes& sizes) {
    restore();
    return timed([&] {
        for (const Recording::Command& command : capture_.work.commands) enqueue(command, sizes);
    });
}

ReplayedFilm Replayer::film() {
    ReplayedFilm film;
    for (const CapturedArray& array : capture_.film) {
        film.emplace_back(array.content->size());
        device_.read(buffers_[array.memory], film.back().data(), film.back().size());
    }
    return film;
}

std::vector<std::size_t> Replayer::launches_of(const std::string& kernel) const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < capture_.work.commands.size(); ++i) {
        const auto* launch = std::get_if<Recording::Launch>(&capture_.work.commands[i]);
        if (launch && kernel_of(*launch) == kernel) places.push_back(i);
    }
    return places;
}

std::vector<ReplayedRun> Replayer::repeat(std::size_t place, unsigned times) {
    restore();
    const auto& commands = capture_.work.commands;
    for (std::size_t i = 0; i < place; ++i) enqueue(commands[i], {});
    // Which of its buffers a kernel writes it does not say, so that all come back that it may.
    std::map<std::size_t, AlignedVector<std::byte>> before;
    const auto& launch = std::get<Recording::Launch>(commands[place]);
    for (const Recording::Argument& argument : capture_.work.argument_lists[launch.arguments]) {
        const auto* memory = std::get_if<std::size_t>(&argument);
        if (!memory || capture_.work.memories[*memory].read_only) continue;
        auto& content = before[*memory];
        content.resize(buffers_[*memory].bytes());
        device_.read(buffers_[*memory], content.data(), content.size());
    }
    std::vector<ReplayedRun> runs;
    for (unsigned i = 0; i < times; ++i) {
        for (const auto& [memory, content] : before)
            device_.write(buffers_[memory], content.data(), content.size());
        runs.push_back(timed([&] { enqueue(commands[place], {}); }));
    }
    return runs;
}

}  // namespace triad
