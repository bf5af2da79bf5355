#pragma once
/// Compressed geometry. It is decoded in the document, before the parser and all that follow see it: what
/// they find are plain buffer views and accessors.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/gltf_file.h"

namespace triad::gltf {

/// EXT_meshopt_compression and KHR_meshopt_compression. A view that cannot be decoded keeps its fallback
/// where there are data; else throws Error(scene) for what is damaged and Error(unsupported) for what this
/// decoder does not know.
void decode_meshopt(nlohmann::json& document, File& file);

/// KHR_draco_mesh_compression. A primitive that cannot be decoded keeps its uncompressed accessors where it
/// has them; else throws Error(scene).
void decode_draco(nlohmann::json& document, File& file);

/// A new buffer view of these bytes, in a buffer of its own. Returns its index.
std::size_t add_view(nlohmann::json& document, File& file, std::vector<std::uint8_t> bytes);

/// Bytes of a buffer of the document. Throws Error(scene) that names `what` where they are not there.
Bytes bytes_of(const File& file, std::size_t buffer, std::uint64_t offset, std::uint64_t length,
               const std::string& what);

}  // namespace triad::gltf
