#pragma once
#include <cstdint>
#include <vector>

#include "io/io.h"

namespace triad {

/// The picture as a PNG file, of primaries and curve of sRGB, its metadata as chunks of text. Throws
/// Error(scene).
std::vector<std::uint8_t> encode_png(const EncodedPicture& picture);

}  // namespace triad
