#pragma once
/// What fuzzes a part of Triad: a function of bytes, which an Error may leave; whatever else leaves it is a
/// find. With libFuzzer each target is a program; without, all are cases of the label `fuzz`, over the finds.
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace triad::fuzz {

using Input = std::span<const std::uint8_t>;
using Target = void (*)(Input);

/// Calls the target. An Error and a lack of memory are answers: the program ends with a sentence for either.
void answer(Target target, Input input);

/// Every target that is linked, by name.
std::map<std::string, Target>& targets();

inline std::string_view text_of(Input input) {
    return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// A file with these bytes, alone in a folder of this process; the next one takes its place.
std::filesystem::path file_of(std::string_view bytes);
inline std::filesystem::path file_of(Input input) { return file_of(text_of(input)); }

/// A .glb of a document and its only buffer.
std::string glb_of(const std::string& document, std::string_view buffer);

/// Loads and validates, as every command does.
Scene load(const std::filesystem::path& path);

}  // namespace triad::fuzz

#ifdef TRIAD_LIBFUZZER
#define TRIAD_FUZZ_TARGET(name)                                                         \
    static void name##_target(triad::fuzz::Input input);                                \
    extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
        triad::fuzz::answer(name##_target, {data, size});                               \
        return 0;                                                                       \
    }                                                                                   \
    static void name##_target(triad::fuzz::Input input)
#else
#define TRIAD_FUZZ_TARGET(name)                                      \
    static void name##_target(triad::fuzz::Input input);             \
    [[maybe_unused]] static const bool name##_is_target =            \
        triad::fuzz::targets().emplace(#name, name##_target).second; \
    static void name##_target(triad::fuzz::Input input)
#endif
