#pragma once
/// Where a render for a panel should take its next samples: where the eye sees the picture change.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "device/device.h"
#include "display/reconstruction.h"
#include "scene/film_sets.h"

namespace triad {

/// The perceived error of the sets of a film, from what more samples change in the picture as it is shown,
/// tone map and all. If a pixel is off by b / n at n samples (which is what tone maps make of noisy bins)
/// with a variance of v / n, then its values at n and at 2 n differ by (b / 2n)^2 + v / 2n in the mean
/// square: its squared error at 2 n.
class PerceivedSets : public SetErrorSource {
  public:
    PerceivedSets(Device& device, const PanelView& panel, const DisplaySettings& display)
        : PerceivedSets([&device]() -> Device& { return device; }, panel, display) {}
    PerceivedSets(CurrentDevice device, const PanelView& panel, const DisplaySettings& display);

    /// Throws DeviceError.
    SetErrors of(const Film& film, const SetSamples& have) override;
    std::string kept() const override;
    void go_on_from(const std::string& kept) override;

  private:
    CurrentDevice device_;
    PanelView panel_;
    DisplaySettings display_;
    std::array<std::vector<float>, 2> before_;  ///< what each set alone showed
    SetSamples had_;
    SetErrors errors_;
};

/// RenderGoal::set_errors of one render.
std::shared_ptr<SetErrorSource> perceived_sets(CurrentDevice device, const PanelView& panel,
                                               const DisplaySettings& display);
inline std::shared_ptr<SetErrorSource> perceived_sets(Device& device, const PanelView& panel,
                                                      const DisplaySettings& display) {
    return perceived_sets([&device]() -> Device& { return device; }, panel, display);
}

}  // namespace triad
