#include "session/choose_view.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/log.h"
#include "scene/framing.h"

namespace triad {
namespace {

constexpr double default_yfov = 35 * pi / 180;  // about a 55 mm lens: models keep their proportions

double aspect_of(uvec2 size) { return double(size.x) / size.y; }

}  // namespace

const SceneCamera* choose_camera(const Scene& scene, const std::string& choice) {
    if (choice.empty()) return scene.cameras.empty() ? nullptr : &scene.cameras.front();
    for (const SceneCamera& camera : scene.cameras)
        if (camera.name == choice) return &camera;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size() && index < scene.cameras.size())
        return &scene.cameras[index];
    std::string sentence = "--camera " + choice + ": there is no such camera; the scene has ";
    if (scene.cameras.empty()) throw Error(Exit::usage, sentence + "none.");
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        sentence += (i ? ", " : "") + std::to_string(i) + " \"" + scene.cameras[i].name + "\"";
    throw Error(Exit::usage, sentence + ".");
}

uvec2 choose_size(const RenderRequest& options, const SceneCamera* camera) {
    if (options.size) return *options.size;
    if (!camera || options.look_at) return {1280, 720};
    const double aspect = camera->orthographic ? camera->magnification.x / camera->magnification.y
                          : camera->aspect > 0 ? camera->aspect
                                               : 1280.0 / 720;
    return {static_cast<unsigned>(std::lround(std::clamp(720 * aspect, 1.0, 16384.0))), 720};
}

View choose_view(const RenderRequest& options, const Scene& scene, const SceneCamera* camera, uvec2 size) {
    const double aspect = aspect_of(size);
    const double asked_yfov = options.fov ? *options.fov * pi / 180 : default_yfov;
    const Bounds bounds = bounds_of(scene);
    if (bounds.empty()) throw Error(Exit::scene, "There is nothing to render: the scene has no triangles.");
    View view;
    if (options.look_at) {
        const auto& n = *options.look_at;
        view = look_at({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, asked_yfov, aspect);
    } else if (options.orbit) {
        const auto [azimuth, elevation, zoom] = *options.orbit;
        const double a = azimuth * pi / 180, e = elevation * pi / 180;
        const dvec3 towards_eye(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
        view = frame(scene, asked_yfov, aspect, towards_eye);
        set_yfov(view, 2 * std::atan(view.extent.y / zoom), aspect);
    } else if (camera) {
        view = view_of(*camera, aspect);
        const double middle = glm::dot(bounds.centre() - view.eye, view.forward);
        view.focus_distance = middle > 0 ? middle : bounds.radius();
        if (options.fov && view.orthographic) warn("--fov has no effect on an orthographic camera.");
        if (options.fov && !view.orthographic) set_yfov(view, asked_yfov, aspect);
    } else {
        view = frame(scene, asked_yfov, aspect);
    }
    if (options.aperture) view.lens_radius = *options.aperture;
    if (options.focus) view.focus_distance = *options.focus;
    return view;
}

bool has_light(const Scene& scene) {
    if (!scene.lights.empty() || scene.environment || scene.sky != vec3(0.0f)) return true;
    bool all_unlit = true;
    for (const MeshInstance& instance : scene.instances)
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            const Material& material = scene.materials[p.material];
            if (material.emission != vec3(0.0f)) return true;
            if (!material.unlit && !p.triangles.empty()) all_unlit = false;
        }
    return all_unlit;
}

}  // namespace triad
