#include "io/gltf_json.h"

#include <cstring>

#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "io/film_blocks.h"

namespace triad::gltf {
namespace {

constexpr std::size_t json_cap = std::size_t(512) << 20;
constexpr int depth_cap = 128;

[[noreturn]] void fail(const std::string& sentence) { throw Error(Exit::scene, sentence); }

std::uint32_t little32(const std::uint8_t* p) {
    return std::uint32_t(p[0]) | std::uint32_t(p[1]) << 8 | std::uint32_t(p[2]) << 16 |
           std::uint32_t(p[3]) << 24;
}

void check_depth(std::string_view text) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > depth_cap)
                fail("The JSON nests deeper than " + std::to_string(depth_cap) + " levels at byte " +
                     std::to_string(i) + "; no glTF needs that.");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

}  // namespace

std::vector<std::uint8_t> read_container(const std::filesystem::path& path) {
    std::vector<std::uint8_t> bytes = read_filled_file(path, file_cap);
    if (bytes.size() >= sizeof film_magic && std::memcmp(bytes.data(), film_magic, sizeof film_magic) == 0)
        fail(path.string() +
             " is a film of Triad, not a scene: triad resolve makes pictures of it, and triad render "
             "--resume " +
             path.string() + " goes on with it.");
    return bytes;
}

Container split_container(Bytes file) {
    constexpr std::uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;
    if (file.size() < 4 || std::memcmp(file.data(), "glTF", 4) != 0)
        return {{reinterpret_cast<const char*>(file.data()), file.size()}, {}, false};

    if (file.size() < 20) fail("The GLB file is cut off: it has " + std::to_string(file.size()) + " bytes.");
    const std::uint32_t version = little32(&file[4]), length = little32(&file[8]);
    if (version != 2)
        throw Error(Exit::unsupported,
                    "The GLB container has version " + std::to_string(version) + "; only 2 is supported.");
    if (length > file.size() || length < 20)
        fail("The GLB header says " + std::to_string(length) + " bytes but the file has " +
             std::to_string(file.size()) + ".");

    Container result;
    std::size_t at = 12;
    for (int chunk = 0; at < length; ++chunk) {
        const std::string name = "GLB chunk " + std::to_string(chunk);
        if (length - at < 8) fail(name + " is cut off in its header.");
        const std::uint32_t size = little32(&file[at]), type = little32(&file[at + 4]);
        at += 8;
        if (size > length - at)
            fail(name + " says " + std::to_string(size) + " bytes but " + std::to_string(length - at) +
                 " are left.");
        if (size % 4 != 0) fail(name + " has " + std::to_string(size) + " bytes, which is no multiple of 4.");
        if ((chunk == 0) != (type == json_chunk))
            fail(name + (chunk == 0 ? " is not JSON." : " is a second JSON chunk."));
        if (type == bin_chunk && chunk != 1) fail(name + " is a BIN chunk in the wrong place.");
        if (type == json_chunk) result.json = {reinterpret_cast<const char*>(&file[at]), size};
        if (type == bin_chunk) result.binary = file.subspan(at, size), result.has_binary = true;
        at += size;
    }
    return result;
}

nlohmann::json parse_json(std::string_view text) {
    if (text.size() > json_cap)
        fail("The JSON has " + std::to_string(text.size()) + " bytes; the limit is " +
             std::to_string(json_cap) + ".");
    if (text.starts_with("\xef\xbb\xbf"))
        fail(
            "The JSON starts with a byte order mark, which glTF forbids; save the file as UTF-8 without "
            "BOM.");
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first != text.npos && std::string_view("{[\"-0123456789tfn").find(text[first]) == text.npos)
        fail("The file is not glTF, which begins with { or, as GLB, with glTF. Convert it to .gltf or .glb.");
    check_depth(text);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& e) {
        fail(std::string("The file is not valid JSON: ") + words_of_json(e) + ".");
    }
}

}  // namespace triad::gltf
