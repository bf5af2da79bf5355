#pragma once
/// Where two pictures differ, as files.
#include <string>
#include <vector>

#include "io/io.h"

namespace triad {

/// Throws Error(usage) for a name that is neither .exr nor .png.
void check_error_map(const std::string& path);

/// EXR: the error of every pixel, and `parts` as more channels; PNG: the error in false colours, from 0 to a
/// round limit that 99 % stay below, with a bar that names them.
void write_error_map(const std::string& path, unsigned width, unsigned height,
                     const std::vector<float>& error, const std::vector<Channel>& parts,
                     const Metadata& metadata);

}  // namespace triad
