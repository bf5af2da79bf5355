#pragma once
/// LDR-FLIP: how different two pictures look when they are flipped between (Andersson, Nilsson,
/// Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
/// Images", with its constants).
#include <vector>

#include "base/rgb_image.h"

namespace triad {

/// Of the paper's monitor: 3840 pixels on 0.7 m, seen from 0.7 m.
inline constexpr double flip_pixels_per_degree = 67.02064327658225;

/// Per pixel, 0 (equal) to 1. Both pictures are display-linear (sRGB primaries, before the sRGB curve);
/// values are cut to [0, 1], NaN counts as 0. Throws std::invalid_argument when the sizes differ or are zero.
std::vector<float> flip_map(const RgbImage& picture, const RgbImage& reference,
                            double pixels_per_degree = flip_pixels_per_degree);

/// The mean of the map.
double mean_flip(const std::vector<float>& map);

}  // namespace triad
