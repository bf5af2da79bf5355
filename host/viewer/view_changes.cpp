/// What a ViewLoop does about the page's changes.
#include <algorithm>
#include <utility>

#include "base/error.h"
#include "session/choose_view.h"
#include "session/panel_file.h"
#include "viewer/view_loop.h"

namespace triad {
namespace {

const std::vector<std::string> tone_maps{"khronos", "aces", "agx", "none"};

bool is_one_of(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void ViewLoop::take_changes(Urgency at_most) {
    const std::vector<ViewChange> changes = exchange_.take_changes(at_most);
    if (changes.empty()) return;
    facts_.message.clear();
    for (const ViewChange& change : changes) {
        try {
            apply(change);
        } catch (const DeviceError&) {
            throw;
        } catch (const Error& error) {
            facts_.message = error.what();
        }
    }
    tell();
}

void ViewLoop::apply(const ViewChange& c) {
    if (c.exposure) request_.style.exposure = facts_.exposure = *c.exposure, restyle_ = true;
    if (c.tone_map) {
        if (!is_one_of(tone_maps, *c.tone_map))
            throw Error(Exit::usage, "There is no tone map \"" + *c.tone_map + "\".");
        request_.style.tone_map = facts_.tone_map = *c.tone_map, restyle_ = true;
    }
    if (c.paused) {
        facts_.paused = *c.paused;
        facts_.phase = facts_.paused ? "paused" : current().complete ? "done" : "render";
    }
    if (c.panel || c.subpixels)
        set_panel(c.panel.value_or(facts_.panel), c.subpixels.value_or(facts_.subpixels));
    if (c.region) set_region(*c.region);
    if (c.scale && *c.scale != facts_.scale) {
        facts_.scale = *c.scale;
        set_region({});  // which was in pixels of another size
        restart();
    }
    if (c.variant) {
        if (!c.variant->empty() && !is_one_of(facts_.variants, *c.variant))
            throw Error(Exit::usage, "The scene has no variant \"" + *c.variant + "\".");
        variant_ = *c.variant;
    }
    look(c);
}

void ViewLoop::look(const ViewChange& c) {
    if (c.camera) set_camera(*c.camera);
    if (!c.orbit && !c.pan && !c.zoom) return;
    OrbitCamera camera = camera_;
    if (c.orbit) camera = orbited(camera, c.orbit->x, c.orbit->y);
    if (c.pan) camera = panned(camera, *c.pan);
    if (c.zoom) camera = zoomed(camera, *c.zoom);
    move_to(camera);
}

void ViewLoop::set_camera(int index) {
    const Scene& scene = scene_->scene();
    if (index >= int(scene.cameras.size()))
        throw Error(Exit::usage, "The scene has no camera " + std::to_string(index) + ".");
    RenderRequest request = request_;
    if (index >= 0) request.look_at.reset(), request.fov.reset();
    const SceneCamera* camera = index >= 0        ? &scene.cameras[std::size_t(index)]
                                : request.look_at ? nullptr
                                                  : choose_camera(scene, request.camera);
    const uvec2 pixels{scene_->settings().width, scene_->settings().height};
    const View view = choose_view(request, scene, camera, pixels);
    request.focus.reset();  // else what is in focus is what it is led around
    const double distance = choose_view(request, scene, camera, pixels).focus_distance;
    move_to(orbit_camera(view, double(pixels.x) / pixels.y, distance, bounds_of(scene)));
    facts_.camera = index;
}

void ViewLoop::move_to(const OrbitCamera& camera) {
    RenderSettings settings = scene_->settings();
    settings.view = camera.view;
    check_limits(settings, scene_->scene());
    camera_ = camera;
    facts_.view = camera_.view, facts_.fov = camera_.fov, facts_.moved = camera_.is_moved;
    restart();
}

/// A page may name panels of the list alone: it opens no files.
void ViewLoop::set_panel(const std::string& name, bool subpixels) {
    if (!name.empty() && !is_one_of(facts_.panels, name))
        throw Error(Exit::usage, "There is no panel \"" + name + "\".");
    ReconstructRequest wanted;
    if (name.empty()) {
        wanted = first_.reconstruct;
        if (!wanted.panel.empty()) wanted = {};
    } else if (!subpixels) {
        wanted.bins = uvec2(3);  // as the panel's own, so that one film serves both
    } else if (name == first_.reconstruct.panel) {
        wanted = first_.reconstruct;
    } else {
        wanted.panel = name;
        wanted.ppd = first_.reconstruct.ppd, wanted.refine_steps = first_.reconstruct.refine_steps;
    }
    facts_.phase = "design";
    tell();
    Reconstruction made = wanted.make();
    panel_ = name.empty() ? nullptr : std::make_shared<const Panel>(panel_named(name));
    facts_.panel = name, facts_.subpixels = subpixels, facts_.method = made.method;
    facts_.phase = facts_.paused ? "paused" : "render";
    const Reconstruction& before = request_.style.reconstruction;
    const bool same_film = made.bins_x == before.bins_x && made.bins_y == before.bins_y &&
                           made.ray_start == before.ray_start && made.ray_start != RayStart::filter;
    request_.style.reconstruction = std::move(made);
    restyle_ = true;
    if (same_film) return;
    starting_ = true;  // other programs may have to be compiled
    restart();
}

void ViewLoop::set_region(std::array<unsigned, 4> region) {
    auto& [x, y, width, height] = region;
    const uvec2 whole = size();
    x = std::min(x, whole.x), y = std::min(y, whole.y);
    width = std::min(width, whole.x - x), height = std::min(height, whole.y - y);
    if (width == 0 || height == 0) region = {};
    if (region == region_) return;
    region_ = facts_.region = region;
    part_ = Growing();
    exchange_.drop_region();
    facts_.region_frame = 0;
    facts_.course = current().course;
    if (facts_.phase == "done" && !current().complete) facts_.phase = "render";
    restyle_ = true;
}

}  // namespace triad
