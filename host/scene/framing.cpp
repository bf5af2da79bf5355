#include "scene/framing.h"

#include <algorithm>
#include <cmath>

#include "scene/farthest_point.h"

namespace triad {
namespace {

/// How near the eye may come to what it shows, in halves of its largest size: what has no width from where
/// one looks (a line seen end on) asks for no distance at all.
constexpr double clearance = 0.02;
/// Of coordinates: differences below have few digits left.
constexpr double least_size = 1e-9;

/// Where an eye at this depth must be along `axis` for the scene to reach equally far to both sides of the
/// picture's middle. The scene lies between two planes through the eye whose slopes are opposite; steeper
/// planes are tried until they hold it. Every step is a Newton step on a convex function that is made of
/// finitely many lines, from below: it ends.
double centred(const FarthestPoint& farthest, const dvec3& axis, const dvec3& forward, double depth) {
    double slope = 0.0, at = 0.0;
    for (int step = 0; step < 64; ++step) {
        const dvec3 p = farthest(axis - slope * forward), q = farthest(-axis - slope * forward);
        const double way_p = glm::dot(forward, p) - depth, way_q = glm::dot(forward, q) - depth;
        const double next = glm::dot(axis, p - q) / (way_p + way_q);
        if (step == 0 || next > slope) at = 0.5 * (glm::dot(axis, p + q) - next * (way_p - way_q));
        if (!(next > slope * (1.0 + 1e-12))) break;
        slope = next;
    }
    return at;
}

}  // namespace

View frame(const Scene& scene, double yfov, double aspect, const dvec3& towards_eye) {
    const FarthestPoint farthest(scene);
    View view = look_at(glm::normalize(towards_eye), dvec3(0.0), yfov, aspect);
    const dvec3 forward = view.forward, axes[2] = {view.right, view.up};

    const double near = glm::dot(forward, farthest(-forward)), far = glm::dot(forward, farthest(forward));
    double size = far - near;
    for (const dvec3& axis : axes) size = std::max(size, glm::dot(axis, farthest(axis) - farthest(-axis)));
    size = std::max(size, least_size * glm::length(farthest.origin()));

    // The points lie on one side of a plane with this slope when the farthest of them does. Two such planes,
    // left and right or below and above, meet in a line, before which the eye may not come.
    double depth = near - (size > 0.0 ? clearance * 0.5 * size : 1.0);
    for (int k = 0; k < 2; ++k) {
        const double slope = framed_share * view.extent[k];
        const dvec3 a = axes[k] - slope * forward, b = -axes[k] - slope * forward;
        depth = std::min(depth, -(glm::dot(a, farthest(a)) + glm::dot(b, farthest(b))) / (2.0 * slope));
    }
    view.eye = farthest.origin() + depth * forward;
    for (const dvec3& axis : axes) view.eye += centred(farthest, axis, forward, depth) * axis;
    view.focus_distance = 0.5 * (near + far) - depth;
    return view;
}

}  // namespace triad
