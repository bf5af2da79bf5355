#pragma once
/// Where a camera stands that shows a whole scene as large as it can.
#include "scene/scene.h"
#include "scene/view.h"

namespace triad {

/// How much of half the picture a framed scene takes, in the tighter of width and height.
inline constexpr double framed_share = 0.95;

/// Looks from the front, slightly right and above, as model viewers do, from where the vertices of all that
/// is drawn reach `framed_share` of the picture in one direction, and are centred in both. `yfov` is the
/// vertical angle in radians. The scene must have something to draw. It depends on nothing but its arguments;
/// what is never seen (coverage of nothing) does not count, unless there is nothing else.
View frame(const Scene& scene, double yfov, double aspect);

}  // namespace triad
