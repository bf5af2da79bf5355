#include "pack/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "base/error.h"
#include "base/hash.h"
#include "pack/ray_filter.h"
#include "scene/limits.h"

namespace triad {
namespace {

/// `value` must be at most `limit`, and a number.
void require_within(double value, double limit, const std::string& what, const char* what_to_do) {
    if (std::abs(value) <= limit) return;
    throw Error(Exit::usage, what + " is " + limits::text_of(value) + ", beyond " + limits::text_of(limit) +
                                 ", the most that single precision can work with: " + what_to_do + ".");
}

void check_view(const View& v) {
    for (int axis = 0; axis < 3; ++axis)
        require_within(v.eye[axis], limits::ray_start, "A coordinate of the camera",
                       "give --look-at a nearer eye, or a wider --fov where the whole scene is framed");
    require_within(v.lens_radius, limits::ray_start, "The radius of the lens", "give a smaller --aperture");
    require_within(v.extent.x, v.orthographic ? limits::ray_start : limits::squared,
                   "Half the width of the view", "give a --size of less extreme proportions");
    require_within(v.extent.y, v.orthographic ? limits::ray_start : limits::squared,
                   "Half the height of the view", "give a --size of less extreme proportions");
    if (v.lens_radius == 0) return;
    require_within(v.focus_distance, limits::squared, "The distance in focus", "give a nearer --focus");
    require_within(v.lens_radius / v.focus_distance, limits::squared,
                   "The radius of the lens over the distance in focus",
                   "give a smaller --aperture or a farther --focus");
}

}  // namespace

void check_limits(const RenderSettings& s, const Scene& scene) {
    check_view(s.view);
    double brightest = std::max({scene.sky.x, scene.sky.y, scene.sky.z});
    if (scene.environment)
        for (const float x : scene.environment->rgb) brightest = std::max(brightest, double(x));
    require_within(s.environment_strength * brightest, limits::brightness,
                   "The brightest radiance of the environment", "give a smaller --env-strength");
}

const char* name_of(RayStart start) {
    switch (start) {
        case RayStart::jitter:
            return "jitter";
        case RayStart::centre:
            return "centre";
        case RayStart::filter:
            return "filter";
    }
    return "";
}

const char* name_of(Spectral spectral) {
    switch (spectral) {
        case Spectral::automatic:
            return "auto";
        case Spectral::off:
            return "off";
        case Spectral::full:
            return "full";
        case Spectral::classic:
            return "classic";
    }
    return "";
}

const char* name_of(Integrator integrator) {
    switch (integrator) {
        case Integrator::automatic:
            return "auto";
        case Integrator::path:
            return "path";
        case Integrator::photons:
            return "photons";
        case Integrator::light:
            return "light";
        case Integrator::photon_map:
            return "photon-map";
    }
    return "";
}

std::string text_of(const RenderSettings& s) {
    std::string text = "{";
    auto add = [&](const char* name, std::initializer_list<double> values) {
        text += (text.size() > 1 ? ", \"" : "\"") + std::string(name) + "\": ";
        if (values.size() > 1) text += "[";
        bool first = true;
        for (double v : values) {
            char number[32];
            std::snprintf(number, sizeof number, "%.17g", v);
            text += (first ? "" : ", ") + std::string(number);
            first = false;
        }
        if (values.size() > 1) text += "]";
    };
    auto name = [&](const char* what, const char* value) {
        text += (text.size() > 1 ? ", \"" : "\"") + std::string(what) + "\": \"" + value + "\"";
    };
    const View& v = s.view;
    add("size", {double(s.width), double(s.height)});
    add("bins", {double(s.bins_x), double(s.bins_y)});
    add("crop", {double(s.crop[0]), double(s.crop[1]), double(s.crop[2]), double(s.crop[3])});
    add("seed", {double(s.seed)});
    add("max_depth", {double(s.max_depth)});
    add("roulette", {s.roulette});
    add("independent", {double(s.independent)});
    if (s.spectral != Spectral::automatic) name("spectral", name_of(s.spectral));
    if (s.integrator != Integrator::path) {
        name("integrator", name_of(s.integrator));
        add("photons", {double(s.photons)});
        add("aim_photons", {double(s.aim_photons)});
        add("photon_radius", {s.photon_radius});
        add("final_gather", {double(s.final_gather)});
    }
    add("transparent", {double(s.transparent)});
    add("eye", {v.eye.x, v.eye.y, v.eye.z});
    add("right", {v.right.x, v.right.y, v.right.z});
    add("up", {v.up.x, v.up.y, v.up.z});
    add("forward", {v.forward.x, v.forward.y, v.forward.z});
    add("orthographic", {double(v.orthographic)});
    add("extent", {v.extent.x, v.extent.y});
    add("lens_radius", {v.lens_radius});
    add("focus_distance", {v.focus_distance});
    add("environment_rotation", {s.environment_rotation});
    add("environment_strength", {s.environment_strength});
    add("flatten_below", {double(s.flatten_below)});
    // Named only where it is not the default, so that films of before keep their settings.
    if (s.ray_start != RayStart::jitter) name("ray_start", name_of(s.ray_start));
    if (s.ray_start == RayStart::filter) {
        const std::vector<float> tables = ray_filter_tables(s);
        const dev::RayFilterShape shape = ray_filter_shape(s);
        text += ", \"ray_filter\": \"" +
                Hash().add(&shape, sizeof shape).add(tables.data(), tables.size() * sizeof(float)).hex() +
                "\"";
    }
    return text + "}";
}

}  // namespace triad
