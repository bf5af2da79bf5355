#pragma once
/// Intel's Open Image Denoise, loaded when it is asked for; nothing links to it.
#include <vector>

#include "scene/film.h"

namespace triad {

/// Mean RGBA of every pixel, its colours denoised by the filter "RT" with the film's guides; alpha as it is.
/// Throws Error(unsupported) when the library is not found or refuses, in words that say how to get it.
std::vector<float> open_image_denoised(const Film& film);

}  // namespace triad
