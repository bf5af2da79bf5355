#pragma once
#include <vector>

namespace triad {

/// Interleaved R, G, B, row by row.
struct RgbImage {
    unsigned width = 0, height = 0;
    std::vector<float> rgb;
};

}  // namespace triad
