#include "panel/frame.h"

#include <algorithm>

#include "panel/design.h"

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

RgbImage boxed_drives(const Panel& panel, const RgbImage& picture, unsigned samples) {
    const TapTable boxes = displaced_box_taps(panel, samples, samples);
    const int w = int(picture.width), h = int(picture.height), n = int(samples);
    RgbImage drives{picture.width / samples, picture.height / samples, {}};
    drives.rgb.resize(std::size_t(drives.width) * drives.height * 3);
    for (unsigned y = 0; y < drives.height; ++y)
        for (unsigned x = 0; x < drives.width; ++x)
            for (unsigned c = 0; c < 3; ++c) {
                const Taps& taps = boxes.of(x, y, c);
                double sum = 0;
                for (unsigned v = 0; v < taps.height; ++v) {
                    const int row = (int(y) * n + taps.first_y + int(v) + h) % h;
                    double across = 0;
                    for (unsigned u = 0; u < taps.width; ++u) {
                        const int column = (int(x) * n + taps.first_x + int(u) + w) % w;
                        across += taps.across[u] *
                                  picture.rgb[(std::size_t(row) * picture.width + unsigned(column)) * 3 + c];
                    }
                    sum += taps.down[v] * across;
                }
                drives.rgb[(std::size_t(y) * drives.width + x) * 3 + c] = float(sum);
            }
    return drives;
}

void put_in_frame(const RgbImage& image, RgbImage& frame) {
    const std::size_t left = (frame.width - image.width) / 2, top = (frame.height - image.height) / 2;
    for (std::size_t y = 0; y < image.height; ++y)
        std::copy_n(image.rgb.begin() + std::ptrdiff_t(y * image.width * 3), image.width * 3,
                    frame.rgb.begin() + std::ptrdiff_t(((y + top) * frame.width + left) * 3));
}

}  // namespace triad
