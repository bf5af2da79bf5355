#include "pack/settings.h"

#include <cstdio>
#include <initializer_list>

#include "base/hash.h"
#include "pack/ray_filter.h"

namespace triad {

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
