#pragma once
/// The header of an OpenEXR file as untrusted bytes, and the same file with a header that a decoder can
/// trust.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/io.h"

namespace triad {

struct CleanExr {
    unsigned width = 0, height = 0;  ///< of the data window
    int x = 0, y = 0;                ///< data window, relative to the display window
    unsigned display_width = 0, display_height = 0;
    std::vector<std::string> channels;  ///< as stored (sorted by name)
    Metadata metadata;                  ///< string, int, float and double attributes
    std::vector<std::uint8_t> bytes;    ///< all offsets kept; foreign attributes are blanked
};

/// Throws Error(scene) with `name` when the header is damaged, when the file is deep or has several parts,
/// when its channels are subsampled, or when it announces more pixels than the limit of image_container.h.
CleanExr clean_exr(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace triad
