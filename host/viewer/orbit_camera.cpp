#include "viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace triad {
namespace {

constexpr double highest = 89.5 * pi / 180;
/// Distances from the target, as shares of the scene's size.
constexpr double nearest = 1e-4, farthest = 1e4;

dvec3 turned(const dvec3& v, const dvec3& axis, double angle) { return glm::angleAxis(angle, axis) * v; }

/// Looks from `eye` to `target`, as far in focus as before in proportion.
OrbitCamera placed(OrbitCamera camera, const dvec3& eye, const dvec3& target) {
    View& view = camera.view;
    const double before = glm::length(camera.target - view.eye), now = glm::length(target - eye);
    const double lens = view.lens_radius, focus = view.focus_distance * (before > 0 ? now / before : 1.0);
    camera.target = target;
    camera.is_moved = true;
    if (view.orthographic) {
        view.eye = eye;
        return camera;
    }
    view = look_at(eye, target, camera.fov * pi / 180, camera.aspect);
    view.lens_radius = lens;
    if (std::abs(focus - now) > 1e-9 * now) view.focus_distance = focus;
    return camera;
}

}  // namespace

OrbitCamera orbit_camera(const View& view, double aspect, double distance, const Bounds& bounds) {
    OrbitCamera camera;
    camera.view = view;
    camera.aspect = aspect;
    camera.size = std::max(bounds.radius(), 1e-9 * glm::length(bounds.centre()));
    if (!(camera.size > 0)) camera.size = 1;
    camera.fov = 2 * std::atan(view.extent.y) * 180 / pi;
    camera.target = view.eye + distance * view.forward;
    return camera;
}

OrbitCamera orbited(const OrbitCamera& camera, double azimuth, double elevation) {
    const View& view = camera.view;
    const dvec3 vertical(0, 1, 0);
    const double now = std::asin(std::clamp(-view.forward.y, -1.0, 1.0));
    // One that begins beyond the limit may come back, and go no further.
    const double next = std::clamp(now + elevation, std::min(now, -highest), std::max(now, highest));
    const dvec3 level = glm::cross(view.forward, vertical);
    const dvec3 side = glm::length(level) > 1e-6 ? glm::normalize(level) : view.right;
    const auto turn = [&](const dvec3& v) { return turned(turned(v, side, now - next), vertical, azimuth); };
    OrbitCamera moved = camera;
    if (view.orthographic) {
        moved.view.right = glm::normalize(turn(view.right));
        moved.view.forward = glm::normalize(turn(view.forward));
        moved.view.up = glm::cross(moved.view.right, moved.view.forward);
    }
    return placed(moved, camera.target + turn(view.eye - camera.target), camera.target);
}

OrbitCamera panned(const OrbitCamera& camera, const dvec2& shift) {
    const View& view = camera.view;
    const double depth = view.orthographic ? 1.0 : glm::length(camera.target - view.eye);
    const double height = 2 * view.extent.y * depth;
    const dvec3 way = -height * (shift.x * view.right + shift.y * view.up);
    return placed(camera, view.eye + way, camera.target + way);
}

OrbitCamera zoomed(const OrbitCamera& camera, double factor) {
    const double low = nearest * camera.size, high = farthest * camera.size;
    if (camera.view.orthographic) {
        OrbitCamera moved = camera;
        const double height = std::clamp(camera.view.extent.y * factor, low, high);
        moved.view.extent *= height / camera.view.extent.y;
        moved.is_moved = true;
        return moved;
    }
    const dvec3 way = camera.view.eye - camera.target;
    const double distance = glm::length(way);
    // From where a file's camera stands beyond the bounds it may come back.
    const double next = std::clamp(distance * factor, std::min(low, distance), std::max(high, distance));
    return placed(camera, camera.target + way * (next / distance), camera.target);
}

}  // namespace triad
