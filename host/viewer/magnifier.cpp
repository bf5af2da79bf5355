#include "viewer/magnifier.h"

#include <algorithm>
#include <array>

#include "base/colour.h"
#include "display/resolve.h"
#include "report/panel_report.h"

namespace triad {
namespace {

/// What 8 bits say to a display.
float drive_of(std::uint8_t code) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(srgb_decode(double(i) / 255));
        return values;
    }();
    return table[code];
}

/// Where a cell of the panel begins, so that every pixel keeps its emitters.
unsigned aligned(unsigned x, unsigned cell) { return x / cell * cell; }

}  // namespace

ViewFrame magnified(const ViewFrame& frame, unsigned x, unsigned y, unsigned across, unsigned zoom) {
    const unsigned cell_x = frame.panel ? frame.panel->cell_x : 1,
                   cell_y = frame.panel ? frame.panel->cell_y : 1;
    const auto first = [&](unsigned at, unsigned low, unsigned cell) {
        return std::max(aligned(at > across / 2 ? at - across / 2 : 0, cell), low);
    };
    ViewFrame lens = frame;
    lens.x = first(x, frame.x, cell_x), lens.y = first(y, frame.y, cell_y);
    lens.width = std::min(across, frame.x + frame.width - lens.x);
    lens.height = std::min(across, frame.y + frame.height - lens.y);
    RgbImage drives{lens.width, lens.height, {}};
    for (unsigned row = 0; row < lens.height; ++row)
        for (unsigned column = 0; column < lens.width; ++column) {
            // A coarse frame has fewer columns than pixels.
            const std::size_t fx = std::size_t(lens.x + column - frame.x) * frame.columns / frame.width,
                              fy = std::size_t(lens.y + row - frame.y) * frame.rows / frame.height;
            const std::uint8_t* rgba = &frame.rgba[4 * (fy * frame.columns + fx)];
            for (int c = 0; c < 3; ++c) drives.rgb.push_back(rgba[3] == 0 ? 0.0f : drive_of(rgba[c]));
        }
    lens.columns = lens.width * zoom, lens.rows = lens.height * zoom;
    std::vector<float> rgba;
    rgba.reserve(std::size_t(lens.columns) * lens.rows * 4);
    const RgbImage light = frame.panel ? magnified(*frame.panel, drives, zoom) : drives;
    const unsigned each = frame.panel ? 1 : zoom;
    for (unsigned row = 0; row < lens.rows; ++row)
        for (unsigned column = 0; column < lens.columns; ++column) {
            const float* rgb = &light.rgb[3 * (std::size_t(row / each) * light.width + column / each)];
            rgba.insert(rgba.end(), {rgb[0], rgb[1], rgb[2], 1.0f});
        }
    lens.rgba = encode_srgb(rgba, 4, 8);
    return lens;
}

}  // namespace triad
