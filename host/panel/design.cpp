#include "panel/design.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "panel/designer.h"

namespace triad {
namespace {

/// Keeps of a table what is the product of its sums over columns and rows.
void separate(Taps& taps) {
    taps.across.assign(taps.width, 0);
    taps.down.assign(taps.height, 0);
    for (unsigned y = 0; y < taps.height; ++y)
        for (unsigned x = 0; x < taps.width; ++x) {
            taps.across[x] += taps.weights[y * taps.width + x];
            taps.down[y] += taps.weights[y * taps.width + x];
        }
    for (unsigned y = 0; y < taps.height; ++y)
        for (unsigned x = 0; x < taps.width; ++x)
            taps.weights[y * taps.width + x] = taps.across[x] * taps.down[y];
}

}  // namespace

void check_design(double ppd, unsigned bins_x, unsigned bins_y) {
    if (!(ppd >= 5 && ppd <= 1000))
        throw Error(Exit::usage, format("Taps for %g pixels per degree: give 5 to 1000.", ppd));
    if (std::min(bins_x, bins_y) < 1 || std::max(bins_x, bins_y) > 16)
        throw Error(Exit::usage,
                    format("Taps for %u x %u bins per pixel: give 1 to 16 each way.", bins_x, bins_y));
}

TapTable design_taps(const Panel& panel, double ppd, const TapDesign& design) {
    check_design(ppd, design.bins_x, design.bins_y);
    if (!(design.reach >= 0 && design.reach <= 3))
        throw Error(Exit::usage,
                    format("Taps that reach %g px beyond the spacing: give 0 to 3.", design.reach));
    if (panel.advice.full_pixel) return full_pixel_taps(design.bins_x, design.bins_y, panel.advice.shift);
    const Designer designer(panel, ppd, design);
    const Designer::Values solution = designer.solve();
    TapTable table = displaced_box_taps(panel, design.bins_x, design.bins_y);
    for (const TapFilter& f : designer.filters()) {
        const Output& o = designer.output(f);
        Taps& taps = table.outputs[(o.y * panel.cell_x + o.x) * 3 + o.channel];
        const auto begin = solution.begin() + std::ptrdiff_t(f.begin), end = begin + f.width * f.height;
        if (f.channel == o.channel) {
            const std::vector<float> cross = std::move(taps.cross);
            taps = {f.first_x - int(o.x * design.bins_x),
                    f.first_y - int(o.y * design.bins_y),
                    f.width,
                    f.height,
                    std::vector<float>(begin, end),
                    {},
                    {},
                    std::move(cross)};
        }
        if (!design.cross_colour) continue;
        taps.cross.resize(3 * f.width * f.height);
        if (f.channel != o.channel)
            std::copy(begin, end, taps.cross.begin() + f.channel * f.width * f.height);
    }
    if (design.separable)
        for (Taps& taps : table.outputs)
            if (taps.across.empty() && taps.cross.empty()) separate(taps);
    return table;
}

}  // namespace triad
