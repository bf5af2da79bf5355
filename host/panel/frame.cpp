#include "panel/frame.h"

#include <algorithm>

namespace triad {
namespace {

constexpr unsigned least_frame = 16;  // px: the widest blur of S-CIELAB's at 45 pixels per degree

bool transforms_fast(unsigned n) {
    for (const unsigned factor : {2u, 3u, 5u, 7u})
        while (n % factor == 0) n /= factor;
    return n == 1;
}

}  // namespace

unsigned frame_of(unsigned size, unsigned samples, unsigned cell) {
    const unsigned first = (least_frame + cell - 1) / cell * cell;
    for (unsigned margin = first; margin < 2 * first; margin += cell)
        if (transforms_fast((size + 2 * margin) * samples)) return margin;
    return first;
}

RgbImage framed(const RgbImage& image, unsigned frame_x, unsigned frame_y) {
    const auto mirror = [](unsigned i, unsigned margin, unsigned n) {
        const unsigned period = 2 * n, m = (i + period - margin % period) % period;
        return std::min(m, period - 1 - m);
    };
    RgbImage result{image.width + 2 * frame_x, image.height + 2 * frame_y, {}};
    result.rgb.resize(std::size_t(result.width) * result.height * 3);
    float* to = result.rgb.data();
    for (unsigned y = 0; y < result.height; ++y) {
        const float* row = image.rgb.data() + std::size_t(mirror(y, frame_y, image.height)) * image.width * 3;
        for (unsigned x = 0; x < result.width; ++x, to += 3)
            std::copy_n(row + std::size_t(mirror(x, frame_x, image.width)) * 3, 3, to);
    }
    return result;
}

}  // namespace triad
