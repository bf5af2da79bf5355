#pragma once
/// A camera that is led around a point.
#include "base/math.h"
#include "scene/view.h"

namespace triad {

struct OrbitCamera {
    View view;
    dvec3 target{0.0};      ///< what it is led around
    double fov = 35;        ///< vertical, degrees; of perspective views
    double aspect = 1;      ///< width / height of the picture
    double size = 1;        ///< of the scene, in scene units: bounds how near and how far it may go
    bool is_moved = false;  ///< a perspective view is that of --look-at eye, target and --fov, bit for bit
};

/// Led around from here on: the target lies on the axis, so far away (above 0). `bounds`: of the scene, not
/// empty.
OrbitCamera orbit_camera(const View& view, double aspect, double distance, const Bounds& bounds);

/// Around the target: about the vertical by `azimuth`, counter-clockwise seen from above, and upwards by
/// `elevation`, radians. It stops half a degree before it looks straight down or up. A perspective view is
/// level afterwards.
OrbitCamera orbited(const OrbitCamera& camera, double azimuth, double elevation);

/// Sideways and upwards, so that what lies at the target's depth moves in the picture by `shift`, in heights
/// of the picture, to the right and upwards.
OrbitCamera panned(const OrbitCamera& camera, const dvec2& shift);

/// The distance from the target times `factor`; of an orthographic view the picture's extent.
OrbitCamera zoomed(const OrbitCamera& camera, double factor);

}  // namespace triad
