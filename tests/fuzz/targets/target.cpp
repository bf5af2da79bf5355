#include "fuzz/targets/target.h"

#include <cstring>
#include <fstream>
#include <new>

#include "base/error.h"
#include "base/log.h"
#include "base/memory_limit.h"
#include "base/temporary_folder.h"
#include "io/io.h"

namespace triad::fuzz {
namespace {

/// No small file has a reason to take more.
constexpr std::uint64_t most_memory = std::uint64_t(1) << 30;

void add32(std::string& to, std::size_t value) {
    const auto word = std::uint32_t(value);
    to.append(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

void answer(Target target, Input input) {
    set_log_level(0);
    set_memory_limit(most_memory);
    try {
        target(input);
    } catch (const Error&) {
    } catch (const std::bad_alloc&) {
    }
}

std::map<std::string, Target>& targets() {
    static std::map<std::string, Target> all;
    return all;
}

std::filesystem::path file_of(std::string_view bytes) {
    static const TemporaryFolder folder;
    const std::filesystem::path path = folder / "input";
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), std::streamsize(bytes.size()));
    return path;
}

std::string glb_of(const std::string& document, std::string_view buffer) {
    const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
    std::string glb = "glTF";
    add32(glb, 2);
    add32(glb, 12 + 8 + padded(document.size()) + 8 + padded(buffer.size()));
    add32(glb, padded(document.size()));
    glb += "JSON" + document + std::string(padded(document.size()) - document.size(), ' ');
    add32(glb, padded(buffer.size()));
    glb.append("BIN\0", 4).append(buffer).append(padded(buffer.size()) - buffer.size(), '\0');
    return glb;
}

Scene load(const std::filesystem::path& path) {
    Scene scene = load_gltf(path);
    validate(scene);
    return scene;
}

}  // namespace triad::fuzz
