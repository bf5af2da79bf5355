#include "scene/view.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace triad {

void set_yfov(View& view, double yfov, double aspect) {
    const double h = std::tan(0.5 * yfov);
    view.extent = {h * aspect, h};
}

View view_of(const SceneCamera& camera, double aspect) {
    View view;
    view.eye = dvec3(camera.to_world[3]);
    view.right = glm::normalize(dvec3(camera.to_world[0]));
    view.forward = -glm::normalize(dvec3(camera.to_world[2]));
    view.up = glm::normalize(dvec3(camera.to_world[1]));
    view.orthographic = camera.orthographic;
    if (camera.orthographic) {
        view.extent = camera.magnification;
        if (view.extent.x / view.extent.y < aspect)
            view.extent.x = view.extent.y * aspect;
        else
            view.extent.y = view.extent.x / aspect;
    } else {
        // yfov is vertical, so a wider picture sees more at the sides by itself; a narrower one must see more
        // above.
        set_yfov(view, camera.yfov, aspect);
        if (camera.aspect > aspect) view.extent *= camera.aspect / aspect;
    }
    return view;
}

View look_at(const dvec3& eye, const dvec3& target, double yfov, double aspect) {
    const dvec3 d = target - eye;
    if (!(glm::dot(d, d) > 0.0))
        throw Error(Exit::usage, "--look-at: eye and target are the same point; give two points.");
    View view;
    view.eye = eye;
    view.forward = glm::normalize(d);
    const dvec3 up =
        std::abs(view.forward.y) > 0.99999 ? dvec3(0, 0, view.forward.y > 0 ? 1 : -1) : dvec3(0, 1, 0);
    view.right = glm::normalize(glm::cross(view.forward, up));
    view.up = glm::cross(view.right, view.forward);
    view.focus_distance = glm::length(d);
    set_yfov(view, yfov, aspect);
    return view;
}

}  // namespace triad
