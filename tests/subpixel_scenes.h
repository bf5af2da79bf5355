#pragma once
/// The synthetic scenes of ../shared/assets/subpixel, and every way from their samples to drives, in plain
/// code that the device's pipeline is compared with.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/rgb_image.h"
#include "io/io.h"
#include "panel/taps.h"
#include "unit/test_assets.h"

namespace subpixel_scenes {

using namespace triad;

inline const std::vector<std::string> names = {"zone",   "edge",    "lines",  "text",
                                               "sphere", "voronoi", "foliage"};

inline std::filesystem::path folder() { return test_assets() / "subpixel"; }
inline bool present() { return std::filesystem::exists(folder() / "zone.exr"); }

inline RgbImage load(const std::string& name) {
    const Picture picture = read_picture(folder() / (name + ".exr"));
    RgbImage image{picture.width, picture.height, {}};
    image.rgb.resize(std::size_t(image.width) * image.height * 3);
    const char* const channels[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < image.rgb.size() / 3; ++i)
            image.rgb[3 * i + c] = picture.find(channels[c])->values[i];
    return image;
}

/// How a picture goes on beyond its border.
enum class Beyond { mirrored, again };

/// Drives of bins, not yet cut to [0, 1].
inline RgbImage filtered(const RgbImage& bins, const TapTable& table, Beyond beyond) {
    RgbImage drives{bins.width / table.bins_x, bins.height / table.bins_y, {}};
    drives.rgb.resize(std::size_t(drives.width) * drives.height * 3);
    const auto mirror = [beyond](int i, unsigned n) {
        return beyond == Beyond::again ? unsigned((i % int(n) + int(n)) % int(n)) : mirrored_index(i, n);
    };
    for (unsigned y = 0; y < drives.height; ++y)
        for (unsigned x = 0; x < drives.width; ++x)
            for (unsigned c = 0; c < 3; ++c) {
                const Taps& taps = table.of(x, y, c);
                double sum = 0;
                for (unsigned ty = 0; ty < taps.height; ++ty)
                    for (unsigned tx = 0; tx < taps.width; ++tx) {
                        const unsigned bx = mirror(int(x * table.bins_x + tx) + taps.first_x, bins.width);
                        const unsigned by = mirror(int(y * table.bins_y + ty) + taps.first_y, bins.height);
                        const float* rgb = bins.rgb.data() + (std::size_t(by) * bins.width + bx) * 3;
                        const std::size_t tap = std::size_t(ty) * taps.width + tx;
                        sum += double(taps.weights[tap]) * rgb[c];
                        for (unsigned j = 0; j < 3 && !taps.cross.empty(); ++j)
                            sum += double(taps.cross[j * taps.weights.size() + tap]) * rgb[j];
                    }
                drives.rgb[(std::size_t(y) * drives.width + x) * 3 + c] = float(sum);
            }
    return drives;
}

inline RgbImage clamped(RgbImage drives) {
    for (float& v : drives.rgb) v = std::clamp(v, 0.0f, 1.0f);
    return drives;
}

/// The bounded refinement (kernels/subpixel/drives.cl).
inline RgbImage refined(const RgbImage& drives, const RefineStencil& s, unsigned steps) {
    const int r = int(s.radius), w = int(drives.width), h = int(drives.height);
    std::vector<double> v(drives.rgb.size()), turned(v.size());
    const auto cut = [](double x) { return std::clamp(x, 0.0, 1.0); };
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = 2 * drives.rgb[i] - cut(drives.rgb[i]);
    for (unsigned step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < v.size(); ++i) turned[i] = 2 * cut(v[i]) - v[i] - drives.rgb[i];
        for (int py = 0; py < h; ++py)
            for (int px = 0; px < w; ++px)
                for (unsigned c = 0; c < 3; ++c) {
                    const std::size_t pixel =
                        std::size_t(py) % s.cell_y * s.cell_x + std::size_t(px) % s.cell_x;
                    const float* weight =
                        s.weights.data() + (pixel * 3 + c) * std::size_t((2 * r + 1) * (2 * r + 1) * 3);
                    double sum = 0;
                    for (int dy = -r; dy <= r; ++dy)
                        for (int dx = -r; dx <= r; ++dx, weight += 3) {
                            if (px + dx < 0 || py + dy < 0 || px + dx >= w || py + dy >= h) continue;
                            const std::size_t i = std::size_t((py + dy) * w + px + dx) * 3;
                            for (unsigned j = 0; j < 3; ++j) sum += double(weight[j]) * turned[i + j];
                        }
                    const std::size_t i = std::size_t(py * w + px) * 3 + c;
                    v[i] += drives.rgb[i] - cut(v[i]) + turned[i] - sum;
                }
    }
    RgbImage shown = drives;
    for (std::size_t i = 0; i < v.size(); ++i) shown.rgb[i] = float(cut(v[i]));
    return shown;
}

}  // namespace subpixel_scenes
