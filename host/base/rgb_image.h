#pragma once
#include <vector>

namespace triad {

/// Interleaved R, G, B, row by row.
struct RgbImage {
    unsigned width = 0, height = 0;
    std::vector<float> rgb;
};

/// Place on an axis of n values that goes on as its mirror image on both sides, as often as needed.
inline unsigned mirrored_index(int i, unsigned n) {
    const int period = 2 * int(n), m = (i % period + period) % period;
    return unsigned(m < int(n) ? m : period - 1 - m);
}

/// Means of blocks of width x height; what is left over at the right and below is dropped.
RgbImage block_means(const RgbImage& image, unsigned width, unsigned height);

}  // namespace triad
