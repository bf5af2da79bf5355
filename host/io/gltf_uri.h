#pragma once
/// Where a glTF says that its bytes are.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace triad::gltf {

/// The payload of a data URI: any media type or none, base64 or percent-encoded. Normal absence: not a data
/// URI. Throws Error(scene) that names `what` when the payload is damaged.
std::optional<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri, const std::string& what);

/// The file that a relative URI names, strictly below `folder`, links followed. Throws Error(scene) that
/// names `what` for a scheme, an absolute path, "..", a NUL, a link that leads out, or nothing there. '+'
/// stays '+'.
std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& folder,
                                  const std::string& what);

}  // namespace triad::gltf
