#include <algorithm>
#include <cmath>

#include "panel/design.h"

namespace triad {
namespace {

struct Row {
    int first = 0;
    std::vector<float> weights;
};

/// The shares of bins of 1 / bins px in the box of one pixel around `centre`.
Row box(double centre, unsigned bins) {
    const double lo = (centre - 0.5) * bins;
    const double nearest = std::round(lo);
    // A border that is on a bin's border but for rounding makes no bin of no width.
    const double begin = std::abs(lo - nearest) < 1e-9 ? nearest : lo, end = begin + bins;
    Row row{int(std::floor(begin)), {}};
    for (double at = std::floor(begin); at < end; ++at) {
        row.weights.push_back(float((std::min(at + 1, end) - std::max(at, begin)) / bins));
    }
    return row;
}

Taps box_taps(const dvec2& centre, unsigned bins_x, unsigned bins_y) {
    const Row x = box(centre.x, bins_x), y = box(centre.y, bins_y);
    Taps taps{x.first,   y.first, unsigned(x.weights.size()), unsigned(y.weights.size()), {}, x.weights,
              y.weights, {}};
    for (const float down : y.weights)
        for (const float across : x.weights) taps.weights.push_back(across * down);
    return taps;
}

}  // namespace

TapTable full_pixel_taps(unsigned bins_x, unsigned bins_y, const dvec2& shift) {
    TapTable table{bins_x, bins_y, 1, 1, {}};
    table.outputs.assign(3, box_taps(dvec2(0.5) + shift, bins_x, bins_y));
    return table;
}

TapTable displaced_box_taps(const Panel& panel, unsigned bins_x, unsigned bins_y) {
    if (panel.advice.full_pixel) return full_pixel_taps(bins_x, bins_y, panel.advice.shift);
    TapTable table{bins_x, bins_y, panel.cell_x, panel.cell_y, {}};
    for (const Output& o : panel_outputs(panel))
        table.outputs.push_back(box_taps(o.centre - dvec2(o.x, o.y), bins_x, bins_y));
    return table;
}

}  // namespace triad
