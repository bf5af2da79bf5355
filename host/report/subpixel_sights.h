#pragma once
/// The subpixel bench to be looked at: one part of a scene by several methods, on the panel and from afar.
#include <string>

#include "bench/subpixel_bench.h"

namespace triad {

/// Figures of the part of the scene with the most contrast: magnified emitters, the same as the eye's sharp
/// part sees them from the distance of `view`, and where S-CIELAB's eye sees errors, in the same colours for
/// all. Empty without pictures.
std::string sights_of(const SubpixelSight& sight, const PanelView& view);

}  // namespace triad
