#pragma once
/// Pixel filters, the same for R, G and B: what anti-aliasing without a panel uses, and what the filters
/// designed for a panel are compared with.
#include <array>
#include <string>
#include <vector>

#include "base/math.h"
#include "panel/taps.h"

namespace triad {

enum class FilterShape { box, tent, gaussian, mitchell, catmull_rom, lanczos, blackman_harris };

/// A separable filter: shape(x) shape(y), stretched so that its support is `width` pixels wide.
struct PixelFilter {
    FilterShape shape = FilterShape::box;
    double width = 1.0;
};

/// Of the names, in the order of FilterShape: "box", "tent", "gaussian", "mitchell", "catmull-rom",
/// "lanczos", "blackman-harris".
const std::vector<std::string>& filter_names();
/// In pixels, as the literature has it: box 1, tent 2, Gaussian 3 (sigma .5), Mitchell 4, Catmull-Rom 4,
/// Lanczos 6 (three lobes), Blackman-Harris 3.
double default_width(FilterShape shape);
/// "NAME" or "NAME:WIDTH". Throws Error(usage) that lists the names, or says what widths there are: above 0,
/// at most 16.
PixelFilter parse_filter(const std::string& text);

/// Value at x pixels from the centre; 0 at and beyond width / 2. Not normalised.
double filter_value(const PixelFilter& filter, double x);

/// Weights of bins: the filter's integral over each, normalised to sum 1 in double and again after rounding.
/// `centres`: where the filters of R, G and B lie, in pixels from the upper left corner of the pixel; those
/// of a panel's emitters give displaced filters.
TapTable filter_taps(const PixelFilter& filter, unsigned bins_x, unsigned bins_y,
                     const std::array<dvec2, 3>& centres = {dvec2(0.5), dvec2(0.5), dvec2(0.5)});

}  // namespace triad
