#pragma once
/// A chart by which a person sees which panel they have: the same thin lines, drawn for one panel after the
/// other. On a display they look grey in the tile of its own panel and coloured in the others.
#include "base/rgb_image.h"
#include "panel/panel.h"
#include "report/small_type.h"

namespace triad {

inline constexpr unsigned chart_tile_width = 128, chart_tile_height = 88;  // px

/// The lines, `samples` per pixel along each axis, display-linear; neither black nor white, so that no taps
/// leave [0, 1].
RgbImage chart_lines(unsigned samples);
/// Drives that show them on a panel.
RgbImage chart_tile(const Panel& panel, double ppd);
/// Of all panels that can be told apart, with their names.
BytePicture panel_chart(double ppd);

}  // namespace triad
