#pragma once
/// The pictures of an error report, as PNG bytes.
#include <cstdint>
#include <string>
#include <vector>

#include "bench/error_bench.h"

namespace triad {

/// 8-bit sRGB PNG of a display-linear picture.
std::vector<std::uint8_t> png_of(const RgbImage& display);

/// False colours from `low` to `high`; values outside get the end's colour, what is not a number black.
struct ColourScale {
    double low = 0, high = 1;
    bool signed_error = false;  ///< blue, pale grey, red about the middle; else dark violet to pale yellow
};
std::vector<std::uint8_t> false_colour_png(const std::vector<float>& values, unsigned width, unsigned height,
                                           const ColourScale& scale);

/// The same, with a bar below that names the values of the colours. Narrow pictures get room for it.
std::vector<std::uint8_t> false_colour_map_png(const std::vector<float>& values, unsigned width,
                                               unsigned height, const ColourScale& scale);

/// The colours of a scale as CSS, "linear-gradient(to right, #... 0%, ...)".
std::string css_gradient(const ColourScale& scale);

/// The smallest of 1, 2, 5 x 10^k that 99 % of |values| stay below; 1 when nothing is finite and above 0.
double round_limit(const std::vector<const std::vector<float>*>& values);

}  // namespace triad
