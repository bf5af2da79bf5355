#include "viewer/view_loop.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/log.h"
#include "base/spans.h"
#include "io/gltf_contents.h"

namespace triad {
namespace {

/// That the first picture after a move may take to render: the rest of .3 s is for stopping what runs, and
/// for showing it.
constexpr double preview_seconds = 0.08;
constexpr unsigned largest_divisor = 16;
constexpr double idle_seconds = 0.5;
/// A film of so many bytes takes a while to be made, during which a move would wait: first the hand rests.
constexpr double large_film = 64e6, rest_seconds = 0.3;

}  // namespace

ViewLoop::ViewLoop(RenderRequest request, Command command, Exchange& exchange)
    : request_(std::move(request)), first_(request_), command_(std::move(command)), exchange_(exchange) {
    facts_.scene = request_.scene_path.empty()
                       ? "built-in"
                       : std::filesystem::path(request_.scene_path).filename().string();
    facts_.exposure = request_.style.exposure, facts_.tone_map = request_.style.tone_map;
    facts_.method = request_.style.reconstruction.method;
    facts_.variant = request_.variant;
    for (const Panel& panel : builtin_panels()) facts_.panels.push_back(panel.name);
    const std::string& panel = request_.reconstruct.panel;
    if (!panel.empty() && std::count(facts_.panels.begin(), facts_.panels.end(), panel) == 0)
        facts_.panels.push_back(panel);
    if (const auto& view = request_.style.reconstruction.panel) {
        panel_ = std::make_shared<const Panel>(view->panel);
        facts_.panel = panel, facts_.subpixels = true;
    }
}

void ViewLoop::run() {
    const struct Unwatch {
        ~Unwatch() { watch_phases({}); }
    } unwatch;
    watch_phases([this](const char* phase) {
        if (!starting_) return;
        facts_.phase = phase;
        tell();
    });
    open();
    while (!exchange_.closed()) {
        take_changes();
        if (variant_)
            reload();
        else if (restyle_)
            show_again();
        else if (divisor_ > 1)
            preview();
        else if (!facts_.paused && !current().complete)
            grow();
        else if (exchange_.has_files())
            serve_or_refuse();
        else
            exchange_.wait(idle_seconds);
    }
}

void ViewLoop::open() {
    const auto region = std::exchange(request_.crop, std::nullopt);
    if (!request_.scene_path.empty()) facts_.variants = gltf_contents(request_.scene_path).variants;
    scene_ = std::make_unique<ViewScene>(request_);
    facts_.device = scene_->device_words();
    for (const SceneCamera& camera : scene_->scene().cameras) facts_.cameras.push_back(camera.name);
    set_camera(-1);
    if (region) set_region(*region);
    restart();
}

/// Another variant. The picture stays until there is one of it, and so does the scene where it fails.
void ViewLoop::reload() {
    RenderRequest request = request_;
    request.variant = *std::exchange(variant_, std::nullopt);
    starting_ = true;
    try {
        scene_->load(request);
        request_ = std::move(request);
        facts_.variant = request_.variant;
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        facts_.message = error.what();
    }
    restart();
}

/// What was rendered is of another picture.
void ViewLoop::restart() {
    whole_ = Growing(), part_ = Growing();
    preview_.reset();
    divisor_ = first_divisor_;
    began_ = Clock::now();
    facts_.course = ViewCourse();
    facts_.kernels.clear();
    restyle_ = false;
    if (!starting_) facts_.phase = facts_.paused ? "paused" : "render";
}

uvec2 ViewLoop::size() const {
    const RenderSettings& all = scene_->settings();
    const auto scaled = [&](unsigned side) {
        return std::max(1u, unsigned(std::lround(side * facts_.scale)));
    };
    return {scaled(all.width), scaled(all.height)};
}

RenderSettings ViewLoop::settings_of(unsigned divisor) const {
    RenderSettings settings = scene_->settings();
    const double pixels = double(settings.width) * settings.height;
    const uvec2 whole = size();
    settings.width = (whole.x + divisor - 1) / divisor, settings.height = (whole.y + divisor - 1) / divisor;
    settings.view = camera_.view;
    settings.crop = divisor > 1 ? std::array<unsigned, 4>{} : region_;
    if (divisor > 1) {  // by paths alone, which no photons keep waiting
        settings.integrator = Integrator::path, settings.photons = 0;
        settings.bins_x = settings.bins_y = 1, settings.ray_start = RayStart::jitter;
        return settings;
    }
    triad::apply(request_.style.reconstruction, settings);
    if (settings.integrator == Integrator::automatic)
        settings.photons =
            std::uint64_t(std::ceil(double(settings.photons) * double(whole.x) * whole.y / pixels));
    return settings;
}

/// One sample per pixel of a smaller picture.
void ViewLoop::preview() {
    const bool is_first = divisor_ >= first_divisor_;
    const auto renderer = scene_->renderer(settings_of(divisor_));
    facts_.packings = scene_->packings();
    RenderGoal goal{.samples = {0, 1}, .follow = false};
    if (!is_first) goal.abandon = [this] { return exchange_.urgency() == Urgency::picture; };
    if (is_first) note_kernels();  // before it are another picture's
    if (is_first) facts_.kernels.clear();
    const RenderResult result = renderer->render_until(goal, [](const Progress&) { return true; });
    if (result.stop == Stop::interrupt) return;
    preview_ = renderer->film();
    show(*preview_, Shown::preview);
    pace_ = double(preview_->pixels()) / std::max(result.seconds, 1e-6);
    const uvec2 whole = size();
    const double needed = std::sqrt(double(whole.x) * whole.y / (pace_ * preview_seconds));
    first_divisor_ = 2;
    while (first_divisor_ < std::min(needed, double(largest_divisor))) first_divisor_ *= 2;
    divisor_ /= 2;
}

RenderGoal ViewLoop::goal_of(Growing& picture) {
    RenderGoal goal = request_.goal();
    const bool photons = picture.renderer->photons() > 0;
    goal.abandon = [this, photons] {
        return exchange_.urgency() >= (photons ? Urgency::picture : Urgency::pause);
    };
    goal.keep.words = camera_.is_moved ? std::vector<std::string>{} : request_.words;
    goal.keep.wanted = [this, &picture] {
        return exchange_.urgency() == Urgency::display || Clock::now() >= next_show_ ||
               (exchange_.has_files() && picture.course.samples >= 1);
    };
    goal.keep.write = [this, &picture](const Film& film) {
        take_changes(Urgency::display);
        if (std::exchange(restyle_, false)) show_around();
        show(film, region_[2] > 0 ? Shown::region : Shown::whole);
        if (picture.course.samples >= 1) serve(film);
    };
    return goal;
}

/// Until it is complete, or the page asks for something else.
void ViewLoop::grow() {
    Growing& picture = current();
    if (!picture.renderer) {
        const RenderSettings settings = settings_of(1);
        const double pixels = double(settings.width) * settings.height;
        if (32 * pixels * settings.bins_x * settings.bins_y > large_film) exchange_.wait(rest_seconds);
        if (exchange_.urgency() >= Urgency::pause) return;
        picture.renderer = scene_->renderer(settings);
    }
    picture.film.reset();
    facts_.packings = scene_->packings();
    facts_.integrator = picture.renderer->integrator();
    const RenderGoal goal = goal_of(picture);
    facts_.wanted_samples = request_.error || request_.time ? 0 : double(goal.samples.end);
    facts_.phase = "render";
    starting_ = false;
    next_show_ = show_time(show_seconds_);
    const RenderResult result = picture.renderer->render_until(goal, [&](const Progress& progress) {
        picture.course.add(progress);
        facts_.course = picture.course;
        tell();
        return exchange_.urgency() < Urgency::pause;
    });
    picture.complete = result.stop != Stop::interrupt;
    if (exchange_.urgency() == Urgency::picture) {
        // A sample was left in its middle: should the change be refused, this picture begins again.
        if (picture.renderer->photons() > 0) picture = Growing();
        return;
    }
    picture.film = picture.renderer->film();
    if (picture.complete) {  // also where it ended before the first estimate
        Progress end;
        end.seconds = result.seconds, end.samples = picture.film->sample_numbers().mean;
        end.relmse = estimated_relmse(*picture.film);
        picture.course.add(end);
        facts_.course = picture.course;
        facts_.phase = "done";
    }
    picture.course.seconds_before += result.seconds;
    show(*picture.film, region_[2] > 0 ? Shown::region : Shown::whole);
}

}  // namespace triad
