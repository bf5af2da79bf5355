#pragma once
/// The shape of an emitter as a function of the plane: area, transform, coverage.
#include <complex>

#include "panel/panel.h"

namespace triad {

/// px^2.
double aperture_area(const Aperture& aperture);
/// Of its area, from the emitter's centre.
dvec2 aperture_centroid(const Aperture& aperture);
/// The integral of exp(-2 pi i f x) over the aperture, over its area; f in cycles per pixel.
std::complex<double> aperture_transform(const Aperture& aperture, const dvec2& f);
/// The area that it shares with the rectangle from lo to hi (which are from the emitter's centre), px^2.
double aperture_overlap(const Aperture& aperture, const dvec2& lo, const dvec2& hi);

}  // namespace triad
