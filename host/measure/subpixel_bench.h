#pragma once
/// The subpixel bench: every method of reconstruction against `triad` at equal rays, by the errors of three
/// eyes.
#include <functional>
#include <optional>

#include "measure/subpixel_score.h"
#include "measure/subpixel_source.h"

namespace triad {

inline constexpr char subpixel_yardstick[] = "triad";
inline constexpr char subpixel_adaptive[] = "triad-adaptive";

struct SubpixelPlan {
    Panel panel;
    double ppd = 45;
    std::vector<unsigned> rays = {9, 36, 144};  ///< per pixel
    unsigned repetitions = 2;                   ///< with other seeds
    std::uint32_t seed = 1;
};

struct SubpixelRow {
    std::string scene, eye, method;
    unsigned rays = 0;          ///< that were asked for
    double rays_per_pixel = 0;  ///< that were traced: whole bins
    ErrorInterval error;        ///< over the repetitions
    double lightness = 0, colour = 0;
    double seconds = 0;  ///< mean of the repetitions
    std::optional<ErrorInterval>
        over_triad;  ///< error less that of triad at these rays, tiles drawn in pairs
};

/// A method that is better than triad, significantly: the interval of the difference lies below 0.
bool beats_triad(const SubpixelRow& row);

/// All methods for so many rays: those of the table of reconstructions that this panel has, pixel filters,
/// triad without refinement, with cross-colour taps, and adaptive where scenes are rendered.
std::vector<SubpixelMethod> subpixel_methods(const SubpixelPlan& plan, unsigned rays, bool rendered);

/// Supersampling with 1 to 8 rays along each axis, whatever the plan's rays: how soon more rays are in vain.
std::vector<std::pair<SubpixelMethod, unsigned>> supersampling_curve(const SubpixelPlan& plan);

/// Adds the rows of one scene. `go_on` is told what was done, and returns false to stop.
void run_subpixel(const SubpixelPlan& plan, const std::string& scene, SubpixelSource& source, bool rendered,
                  const std::function<bool(const std::string&)>& go_on, std::vector<SubpixelRow>& rows);

}  // namespace triad
