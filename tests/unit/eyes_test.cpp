// One design for three eyes: what no filter at the emitters may beat by more than 3 %.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "panel/design.h"
#include "panel/pixel_filter.h"
#include "panel/tile_metric.h"
#include "subpixel_scenes.h"

using namespace triad;
using namespace subpixel_scenes;

namespace {

/// A pixel filter around each emitter.
TapTable at_emitters(const std::string& filter, const Panel& panel) {
    TapTable table{3, 3, panel.cell_x, panel.cell_y, {}};
    const std::vector<Output> outputs = panel_outputs(panel);
    for (std::size_t i = 0; i < outputs.size(); i += 3) {
        std::array<dvec2, 3> centres;
        for (std::size_t c = 0; c < 3; ++c)
            centres[c] = outputs[i + c].centre - dvec2(outputs[i + c].x, outputs[i + c].y);
        const TapTable pixel = filter_taps(parse_filter(filter), 3, 3, centres);
        table.outputs.insert(table.outputs.end(), pixel.outputs.begin(), pixel.outputs.end());
    }
    return table;
}

}  // namespace

TEST(Eyes, none_sees_a_filter_at_the_emitters_do_better_by_more_than_3_percent) {
    if (!present()) GTEST_SKIP() << "no " << folder();
    std::array<double, all_eyes.size()> worst{};
    for (const char* name : {"rgb", "qd-oled", "pentile"})
        for (const double ppd : {30.0, 45.0, 110.0}) {
            const Panel panel = builtin_panel(name).value();
            const TapTable taps = design_taps(panel, ppd);
            const RefineStencil stencil = design_refine(panel, ppd);
            for (const char* scene : {"text", "lines", "foliage", "voronoi"}) {
                const RgbImage picture = load(scene), bins = block_means(picture, 4, 4);
                const TileMetric metric(panel, ppd, block_means(picture, 2, 2), 6);
                const auto errors = [&](const RgbImage& drives) {
                    const auto tiles = metric.of(drives);
                    std::array<double, all_eyes.size()> e{};
                    for (std::size_t i = 0; i < e.size(); ++i) {
                        double squares = 0, count = 0;
                        for (std::size_t t = 0; t < tiles[i].samples.size(); ++t)
                            squares += tiles[i].lightness[t] + tiles[i].colour[t],
                                count += tiles[i].samples[t];
                        e[i] = std::sqrt(squares / count);
                    }
                    return e;
                };
                const auto triad = errors(refined(filtered(bins, taps, Beyond::mirrored), stencil, 5));
                for (const char* filter : {"tent", "mitchell", "lanczos"}) {
                    const auto other =
                        errors(clamped(filtered(bins, at_emitters(filter, panel), Beyond::mirrored)));
                    for (std::size_t i = 0; i < other.size(); ++i) {
                        worst[i] = std::max(worst[i], triad[i] / other[i]);
                        EXPECT_LT(triad[i], 1.03 * other[i]) << eye_name(all_eyes[i]) << ", " << name << ", "
                                                             << ppd << ", " << scene << ", " << filter;
                    }
                }
            }
        }
    std::printf("worst: %.3f %.3f %.3f\n", worst[0], worst[1], worst[2]);
}
