#pragma once
/// The bytes of a file's images.
#include <cstdint>
#include <vector>

#include "io/gltf_file.h"

namespace triad::gltf {

/// Encoded, as they are stored. Throws Error(scene) where a file cannot be read.
std::vector<std::uint8_t> bytes_of(const ImageSource& source);

}  // namespace triad::gltf
