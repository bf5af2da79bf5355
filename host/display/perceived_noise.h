#pragma once
/// How much of a render's noise the eye sees on a panel, known from the halves of its film.
#include <optional>

#include "device/device.h"
#include "display/resolve.h"
#include "panel/panel.h"

namespace triad {

/// Estimates the noise's share of the perceived error (panel/perceived.h): both halves of the film are shown
/// with this exposure and tone map, and half their difference is as noisy as the picture. Aliasing, blur and
/// fringes, which more samples do not mend, are not in it. The film's bins count as one.
class PerceivedNoise {
  public:
    PerceivedNoise(Device& device, const Panel& panel, double ppd, const DisplaySettings& display)
        : PerceivedNoise([&device]() -> Device& { return device; }, panel, ppd, display) {}
    PerceivedNoise(CurrentDevice device, const Panel& panel, double ppd, const DisplaySettings& display);

    /// None: not known yet, because a half has no samples. Throws DeviceError.
    std::optional<double> of(const Film& film) const;

  private:
    CurrentDevice device_;
    Panel panel_;
    double ppd_;
    DisplaySettings display_;
};

}  // namespace triad
