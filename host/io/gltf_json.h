#pragma once
/// The untrusted text of a glTF file: its container, its JSON, and every check that needs the JSON alone.
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triad::gltf {

using Bytes = std::span<const std::uint8_t>;

/// The two parts of a file. Both point into the bytes they were taken from.
struct Container {
    std::string_view json;
    Bytes binary;             ///< the BIN chunk of a .glb
    bool has_binary = false;  ///< false: .gltf, or a .glb without BIN chunk
};

constexpr std::uint64_t file_cap = std::uint64_t(4) << 30;  ///< bytes of one file

/// The bytes of a .gltf or .glb. Throws Error(scene) when there are none, or when they are those of a film.
std::vector<std::uint8_t> read_container(const std::filesystem::path& path);

/// Tells .glb from .gltf by the first bytes and takes a .glb apart. Throws Error(scene) for a damaged
/// container, Error(unsupported) for another container version.
Container split_container(Bytes file);

/// Parses after a scan that bounds the nesting, so that no recursive code ever sees a deep document. Throws
/// Error(scene).
nlohmann::json parse_json(std::string_view text);

/// Checks what must hold before anything else is worth a look: asset, the glTF version (Error(unsupported)
/// when it is another) and the lists of extensions are well formed.
void check_header(nlohmann::json& document);

/// Checks everything else that the document alone can show: types, required members, numbers, array
/// lengths, that every index names an existing element, and that the nodes are trees of bounded depth. Throws
/// Error(scene) that names the member. Integers written as floats (3.0) become integers.
void check_document(nlohmann::json& document);

}  // namespace triad::gltf
