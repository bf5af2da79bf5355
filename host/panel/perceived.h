#pragma once
/// How far what a display shows is from the picture it should show, as the eye sees both.
#include "base/rgb_image.h"
#include "panel/eye.h"
#include "panel/panel.h"

namespace triad {

/// The light of a panel, `samples` x `samples` per pixel, as display-linear R, G and B in the panel's own
/// primaries (values above 1 inside of emitters: their mean over a lit white pixel is 1). Drives are cut to
/// [0, 1], NaN to 0.
RgbImage simulate_panel(const Panel& panel, const RgbImage& drives, unsigned samples);

struct PerceivedChoice {
    double ppd = 45;
    Eye eye = Eye::scielab;
    unsigned border = 8;  ///< px that no number counts, on each side; fewer where the picture is small
};

/// In units of about one CIELAB unit at mid grey.
struct PerceivedError {
    double error = 0;                ///< sqrt(lightness^2 + colour^2)
    double lightness = 0;            ///< root mean square
    double colour = 0;               ///< root mean square of both colour axes: fringes
    double de_mean = 0, de_p95 = 0;  ///< of CIELAB's colour difference after the eye's blur
    RgbImage map;  ///< per sample: the differences along lightness, red-green and blue-yellow
};

/// `drives`: as shown, W x H, display-linear. `reference`: display-linear, an integer number of samples per
/// pixel along both axes, the same. Throws Error(comparison) for sizes that do not fit.
PerceivedError perceived_error(const Panel& panel, const RgbImage& drives, const RgbImage& reference,
                               const PerceivedChoice& choice = {});

}  // namespace triad
