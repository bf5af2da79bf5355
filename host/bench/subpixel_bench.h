#pragma once
/// The subpixel bench: every method of reconstruction against `triad` at equal rays, by the errors of three
/// eyes.
#include <functional>
#include <optional>

#include "bench/subpixel_source.h"
#include "panel/subpixel_score.h"

namespace triad {

inline constexpr char subpixel_yardstick[] = "triad";
inline constexpr char subpixel_adaptive[] = "triad-adaptive";

struct SubpixelPlan {
    std::vector<PanelView> displays;
    std::vector<unsigned> rays = {9, 36, 144};  ///< per pixel
    unsigned repetitions = 2;                   ///< with other seeds
    std::uint32_t seed = 1;
};

struct SubpixelRow {
    std::string scene, panel;
    double ppd = 0;
    std::string eye, method;
    unsigned rays = 0;          ///< that were asked for
    double rays_per_pixel = 0;  ///< that were traced: whole bins
    ErrorInterval error;        ///< over the repetitions
    double lightness = 0, colour = 0;
    double seconds = 0;  ///< mean of the repetitions
    std::optional<ErrorInterval>
        over_triad;  ///< error less that of triad at these rays, tiles drawn in pairs
};

/// Whether the row is of a method that is compared with triad: adaptive sampling is triad itself.
bool is_compared(const SubpixelRow& row);
/// A method that is better than triad, significantly: the interval of the difference lies below 0.
bool beats_triad(const SubpixelRow& row);

/// A display with the methods that the bench has for it: those of the table of reconstructions that its panel
/// has, pixel filters, triad without refinement, and with adaptive sampling.
struct SubpixelDisplay {
    PanelView view;
    std::vector<SubpixelMethod> methods;
};
SubpixelDisplay subpixel_display(const PanelView& view);

/// N x N rays in a grid. From 1 to 8 the bench runs all, whatever the plan's rays, and shows how soon more
/// rays are in vain.
SubpixelMethod supersampling(unsigned side);

/// A scene of the bench; made when its turn comes.
struct SubpixelSubject {
    std::string name;
    std::function<std::unique_ptr<SubpixelSource>()> make;
};

/// A scene to be looked at: what some methods show of it on the first display, by the most rays of the plan.
struct SubpixelSight {
    std::string scene;
    unsigned samples = 0, rays = 0;  ///< of the reference, per pixel along each axis; per pixel
    RgbImage reference;
    std::vector<std::pair<std::string, RgbImage>> drives;  ///< by method: box, displaced, triad
};

/// Adds the rows of one scene after the other, and a sight of each. `go_on` is told what was done, and
/// returns false to stop: what was measured is there. Rays of a scene are traced once for all displays.
void run_subpixel(const SubpixelPlan& plan, const std::vector<SubpixelSubject>& subjects,
                  const std::function<bool(const std::string&)>& go_on, std::vector<SubpixelRow>& rows,
                  std::vector<SubpixelSight>& sights);

}  // namespace triad
