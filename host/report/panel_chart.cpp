#include "report/panel_chart.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "panel/design.h"

namespace triad {
namespace {

constexpr const char* names[] = {"off",     "rgb",         "bgr",     "vrgb",       "vbgr",
                                 "qd-oled", "qd-oled@180", "pentile", "pentile@180"};
constexpr unsigned columns = 3, gap = 16, zoom = 2;

/// 1 on a line: lines of `width` px, `period` px apart, whose normal is turned by `degrees` from the x axis.
bool on_line(const dvec2& at, double degrees, double period, double width) {
    const double turn = degrees * pi / 180, d = at.x * std::cos(turn) + at.y * std::sin(turn);
    return d - period * std::floor(d / period) < width;
}

/// Fans of dark lines: nearly upright, nearly level, and slanted.
double light(const dvec2& at) {
    const double third = chart_tile_width / 3.0;
    const double degrees = at.x < third ? 7 : at.x < 2 * third ? 83 : 45;
    return on_line(at, degrees, 5, 1.2) ? 0.2 : 0.75;
}

}  // namespace

RgbImage chart_lines(unsigned samples) {
    RgbImage image{chart_tile_width * samples, chart_tile_height * samples, {}};
    for (unsigned y = 0; y < image.height; ++y)
        for (unsigned x = 0; x < image.width; ++x)
            image.rgb.insert(image.rgb.end(), 3, float(light((dvec2(x, y) + 0.5) / double(samples))));
    return image;
}

RgbImage chart_tile(const Panel& panel, double ppd) {
    constexpr unsigned samples = 9, bins = 3;
    const RgbImage film = block_means(chart_lines(samples), samples / bins, samples / bins);
    const TapTable table = kept_taps(panel, ppd, published_design);
    RgbImage drives{chart_tile_width, chart_tile_height, {}};
    for (unsigned y = 0; y < drives.height; ++y)
        for (unsigned x = 0; x < drives.width; ++x)
            for (unsigned c = 0; c < 3; ++c) {
                const Taps& taps = table.of(x, y, c);
                double sum = 0;
                for (unsigned v = 0; v < taps.height; ++v)
                    for (unsigned u = 0; u < taps.width; ++u) {
                        const unsigned column = mirrored_index(int(x * bins + u) + taps.first_x, film.width),
                                       row = mirrored_index(int(y * bins + v) + taps.first_y, film.height);
                        sum += double(taps.weights[v * taps.width + u]) *
                               film.rgb[(std::size_t(row) * film.width + column) * 3 + c];
                    }
                drives.rgb.push_back(float(std::clamp(sum, 0.0, 1.0)));
            }
    return drives;
}

BytePicture panel_chart(double ppd) {
    const unsigned count = unsigned(std::size(names)), rows = (count + columns - 1) / columns;
    const unsigned step_x = chart_tile_width + gap, step_y = chart_tile_height + gap + type_height(zoom) + 6;
    const auto grey = [](double v) { return std::uint8_t(std::lround(255 * srgb_encode(v))); };
    BytePicture chart(gap + columns * step_x, gap + rows * step_y, {grey(0.4), grey(0.4), grey(0.4)});
    for (unsigned i = 0; i < count; ++i) {
        // Whole cells from the corner: taps of a panel are right in their own pixels alone.
        const unsigned left = gap + i % columns * step_x, top = gap + i / columns * step_y;
        const RgbImage tile = chart_tile(builtin_panel(names[i]).value(), ppd);
        for (unsigned y = 0; y < tile.height; ++y)
            for (unsigned x = 0; x < tile.width; ++x) {
                const float* rgb = tile.rgb.data() + (std::size_t(y) * tile.width + x) * 3;
                chart.set(left + x, top + y, {grey(rgb[0]), grey(rgb[1]), grey(rgb[2])});
            }
        draw_type(chart, names[i], left, top + tile.height + 4, zoom, {0, 0, 0});
    }
    return chart;
}

}  // namespace triad
