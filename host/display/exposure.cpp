#include "display/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace triad {
namespace {

constexpr std::size_t block = 8;
constexpr double mid_grey = 0.18, darkest_share = 1.0 / 64;

/// Sums over a block of pixels.
struct Block {
    double luminance = 0, coverage = 0;
};

/// `pixel(i)` gives RGBA of a pixel.
template <class Pixel>
double exposure_of(std::size_t width, std::size_t height, Pixel pixel) {
    const std::size_t columns = (width + block - 1) / block;
    std::vector<Block> blocks(columns * ((height + block - 1) / block));
    Block all;
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const auto p = pixel(y * width + x);
            const double luminance = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
            Block& b = blocks[y / block * columns + x / block];
            b.luminance += luminance, b.coverage += p[3];
            all.luminance += luminance, all.coverage += p[3];
        }
    if (!(all.coverage > 0) || !(all.luminance > 0) || !std::isfinite(all.luminance)) return 0;
    const double darkest = darkest_share * all.luminance / all.coverage;
    double sum = 0;
    for (const Block& b : blocks)
        if (b.coverage > 0) sum += b.coverage * std::log2(std::max(b.luminance / b.coverage, darkest));
    const double ev = std::log2(mid_grey) - sum / all.coverage;
    return std::clamp(std::round(10 * ev) / 10, -64.0, 64.0);
}

}  // namespace

double automatic_exposure(const Film& film) {
    return exposure_of(film.width, film.pixels() / std::max<std::size_t>(film.width, 1),
                       [&](std::size_t i) { return pixel_mean(film, i); });
}

double automatic_exposure(std::span<const float> rgba, std::size_t width) {
    return exposure_of(width, rgba.size() / 4 / std::max<std::size_t>(width, 1),
                       [&](std::size_t i) { return rgba.subspan(4 * i, 4); });
}

}  // namespace triad
