#pragma once
/// Where a camera stands that shows a whole scene as large as it can.
#include "scene/scene.h"
#include "scene/view.h"

namespace triad {

/// How much of half the picture a framed scene takes, in the tighter of width and height.
inline constexpr double framed_share = 0.95;

/// Towards the eye of a scene without a camera: from the front, slightly right and above, as model viewers
/// do.
inline const dvec3 front_view(0.5, 0.35, 1.0);

/// Looks against `towards_eye`, from where the vertices of all that
/// is drawn reach `framed_share` of the picture in one direction, and are centred in both. `yfov` is the
/// vertical angle in radians. The scene must have something to draw. It depends on nothing but its arguments;
/// what is never seen (coverage of nothing) does not count, unless there is nothing else.
View frame(const Scene& scene, double yfov, double aspect, const dvec3& towards_eye = front_view);

}  // namespace triad
