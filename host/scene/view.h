#pragma once
/// Where a picture is taken from: a camera made ready for one picture's aspect.
#include "base/math.h"
#include "scene/scene.h"

namespace triad {

/// right, up and forward are unit and orthogonal, in world space. The image plane at distance 1 along forward
/// spans
/// +-extent (orthographic: +-extent in scene units at any distance).
struct View {
    dvec3 eye{0.0};
    dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
    bool orthographic = false;
    dvec2 extent{1.0};
    double lens_radius = 0.0;     ///< scene units; 0: pinhole
    double focus_distance = 1.0;  ///< along forward
};

/// How far from the eye rays may start: on the lens, or on the image plane of an orthographic view.
inline double lens_reach(const View& view) {
    return view.lens_radius + (view.orthographic ? view.extent.x + view.extent.y : 0.0);
}

/// A camera of the file in a picture of width / height `aspect`. A camera that asks for another aspect is
/// shown whole: the picture sees more on two sides.
View view_of(const SceneCamera& camera, double aspect);

/// From eye to target with +y up (or +z when looking along y). `yfov` is the vertical angle in radians.
/// Throws Error(usage) when eye and target coincide.
View look_at(const dvec3& eye, const dvec3& target, double yfov, double aspect);

/// The same view with another vertical angle (perspective views only).
void set_yfov(View& view, double yfov, double aspect);

}  // namespace triad
