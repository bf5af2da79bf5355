/// What a capture may be: a file is believed in nothing that a replay would stumble over.
#include <algorithm>
#include <variant>

#include "capture/capture_header.h"
#include "kernels/types.h"

namespace triad {
namespace {

using Refuse = std::function<void(const std::string&)>;

constexpr std::uint64_t largest_side = 1u << 20, largest_launch = std::uint64_t(1) << 40,
                        largest_local = 1u << 16;

/// Programs are written to a folder, and read from one, by their paths.
bool is_plain_path(const std::string& path) {
    return !path.empty() && path.size() < 200 && path.front() != '/' &&
           path.find("..") == std::string::npos && std::all_of(path.begin(), path.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '-' || c == '.' || c == '/';
           });
}

/// They become words of a compiler's command.
bool is_plain_word(const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '.' || c == '-' || c == '+';
    });
}

void check_commands(const Recording& work, const Refuse& refuse) {
    const auto within = [&](std::size_t place, const auto& all, const char* what) {
        if (place >= all.size()) refuse(std::string("it names a ") + what + " that it does not have");
    };
    for (const Recording::Command& command : work.commands) {
        if (const auto* write = std::get_if<Recording::Write>(&command)) {
            within(write->memory, work.memories, "buffer");
            const std::uint64_t bytes = work.memories[write->memory].bytes;
            if (write->offset > bytes || write->content->size() > bytes - write->offset)
                refuse("it writes beyond the end of a buffer");
        } else if (const auto* fill = std::get_if<Recording::FillZero>(&command)) {
            within(fill->memory, work.memories, "buffer");
        } else {
            const auto& launch = std::get<Recording::Launch>(command);
            within(launch.function, work.functions, "kernel");
            within(launch.arguments, work.argument_lists, "list of arguments");
            if (launch.items == 0 || launch.items > largest_launch || launch.local > largest_local)
                refuse("a launch has no work-items, or too many");
        }
    }
}

void check_film(const Capture& capture, const Refuse& refuse) {
    if (capture.width == 0 || capture.height == 0 || capture.width > largest_side ||
        capture.height > largest_side || capture.bins == 0 || capture.bins > FILM_MOST_BINS * FILM_MOST_BINS)
        refuse("the size of its film is out of range");
    const std::uint64_t pixels = capture.width * capture.height;
    std::uint64_t covered[4] = {};  // pixels, by kind; bands follow each other
    for (const CapturedArray& array : capture.film) {
        if (array.memory >= capture.work.memories.size()) refuse("it names a buffer that it does not have");
        std::uint64_t& at = covered[std::size_t(array.what)];
        if (array.first_pixel != at || array.pixels == 0 || array.pixels > pixels - at)
            refuse("the arrays of its film do not fit together");
        at += array.pixels;
        std::uint64_t bytes = 0;
        switch (array.what) {
            case CapturedArray::What::sums:
                bytes = array.pixels * capture.bins * FILM_CHANNELS * sizeof(std::int64_t);
                break;
            case CapturedArray::What::half_sums:
                bytes = array.pixels * 3 * sizeof(std::int64_t);
                break;
            case CapturedArray::What::samples:
                bytes = array.pixels * sizeof(std::uint32_t);
                break;
            case CapturedArray::What::counters:
                bytes = 2 * COUNTERS * sizeof(std::uint32_t);
                break;
        }
        if (array.content->size() != bytes || capture.work.memories[array.memory].bytes != bytes)
            refuse("an array of its film has another size than the film");
    }
    if (!std::all_of(std::begin(covered), std::end(covered), [&](std::uint64_t n) { return n == pixels; }))
        refuse("its film lacks pixels");
}

}  // namespace

void check_capture(const Capture& capture, const Refuse& refuse) {
    const Recording& work = capture.work;
    for (const Recording::Source& source : work.sources) {
        if (!is_plain_path(source.path)) refuse("a program has no plain path");
        for (const auto& [name, value] : source.options)
            if (!is_plain_word(name) || !is_plain_word(value))
                refuse("an option of a program is no plain word");
    }
    for (const Recording::Function& function : work.functions)
        if (function.source >= work.sources.size()) refuse("it names a program that it does not have");
    for (const Recording::Memory& memory : work.memories) {
        if (memory.bytes == 0) refuse("a buffer is empty");
        if (memory.content && memory.content->size() != memory.bytes)
            refuse("what a buffer holds has another size than the buffer");
    }
    for (const auto& list : work.argument_lists)
        for (const Recording::Argument& argument : list) {
            const auto* const place = std::get_if<std::size_t>(&argument);
            if (place && *place >= work.memories.size()) refuse("it names a buffer that it does not have");
        }
    check_commands(work, refuse);
    check_film(capture, refuse);
}

}  // namespace triad
