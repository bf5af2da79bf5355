#pragma once
/// Linear pictures as floats, without OpenImageIO: EXR by OpenEXR itself, Radiance .hdr here. A picture whose
/// sky is a map, or one that is compared, so starts at once (image_formats.h).
#include <cstddef>
#include <functional>
#include <string>

#include "io/exr_header.h"
#include "io/image_container.h"

namespace triad {

/// Takes rows in turn from the top: how many, and the values of all channels, interleaved. A file that ends
/// early has so cost little memory.
using TakeRows = std::function<void(unsigned, const float*)>;

/// Channels in the order of `exr.channels`; halves and whole numbers become floats of the same value. Throws
/// Error(scene) with `name` when data are damaged or missing.
void decode_exr(const std::string& name, const CleanExr& exr, const TakeRows& take);

/// R, G and B of clean_hdr's picture: bytes times 2^(exponent - 136) (Ward, "Real Pixels", Graphics Gems II,
/// 1991, without the half that Ward adds, as other readers do), flat or run-length-encoded in the old way or
/// the new. Throws Error(scene) with `name` and the row where data are damaged or missing.
void decode_hdr(const std::string& name, const CleanImage& hdr, const TakeRows& take);

/// Threads for OpenEXR to pack or unpack so many values with; 0: the caller's own.
int exr_threads(std::size_t values);

}  // namespace triad
