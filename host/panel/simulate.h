#pragma once
/// The light that a panel gives.
#include <vector>

#include "base/rgb_image.h"
#include "panel/panel.h"

namespace triad {

/// The light of a panel, `samples` x `samples` per pixel, as display-linear R, G and B in the panel's own
/// primaries; inside of emitters values are above 1, so that their mean over a lit white pixel is 1. Drives
/// (W x H, display-linear) are cut to [0, 1], NaN to 0. What emitters give beyond the border is lost,
/// or, of a picture that repeats, comes in on the other side.
RgbImage simulate_panel(const Panel& panel, const RgbImage& drives, unsigned samples, bool repeats = false);

}  // namespace triad
