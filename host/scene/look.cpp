#include "scene/look.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"

namespace triad {
namespace {

constexpr struct {
    const char* name;
    Look look;
} looks[] = {{"studio", Look::studio}, {"sky", Look::sky}, {"white", Look::white}};

constexpr unsigned map_width = 256, map_height = 128;

using Radiance = std::function<dvec3(const dvec3& direction)>;

/// Of texel (x, y) of a lat-long map: +x lies in its middle, +z to the right of it.
dvec3 direction_of(unsigned x, unsigned y) {
    const double theta = pi * (y + 0.5) / map_height, phi = 2 * pi * ((x + 0.5) / map_width - 0.5);
    return {std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
}

/// Irradiance of what faces up.
dvec3 irradiance_above(const Radiance& radiance) {
    dvec3 sum(0.0);
    for (unsigned y = 0; y < map_height / 2; ++y)
        for (unsigned x = 0; x < map_width; ++x) {
            const dvec3 d = direction_of(x, y);
            const double sine = std::sin(pi * (y + 0.5) / map_height);
            sum += radiance(d) * d.y * sine;
        }
    return sum * (2 * pi / map_width) * (pi / map_height);
}

EnvironmentMap map_of(const Radiance& radiance, double scale) {
    EnvironmentMap map{map_width, map_height, {}};
    for (unsigned y = 0; y < map_height; ++y)
        for (unsigned x = 0; x < map_width; ++x) {
            const dvec3 value = radiance(direction_of(x, y)) * scale;
            for (int c = 0; c < 3; ++c) map.rgb.push_back(float(value[c]));
        }
    return map;
}

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A square light with soft edges, `half` wide as a tangent, seen in direction `d`.
double soft_box(const dvec3& d, const dvec3& middle, double half) {
    const dvec3 axis = glm::normalize(middle);
    const double along = glm::dot(d, axis);
    if (along <= 0.05) return 0;
    const dvec3 right = glm::normalize(glm::cross(axis, dvec3(0, 1, 0.001))), up = glm::cross(right, axis);
    const double u = std::abs(glm::dot(d, right)) / along, v = std::abs(glm::dot(d, up)) / along;
    return (1 - smooth(0.8 * half, 1.1 * half, u)) * (1 - smooth(0.8 * half, 1.1 * half, v));
}

/// They end above the horizon.
dvec3 studio_boxes(const dvec3& d) {
    const dvec3 boxes = dvec3(1.06, 1.0, 0.93) * (7.0 * soft_box(d, {-0.9, 0.75, 0.8}, 0.42)) +
                        dvec3(0.92, 0.98, 1.08) * (2.2 * soft_box(d, {1.2, 0.6, 0.5}, 0.4)) +
                        dvec3(1.0) * (5.0 * soft_box(d, {0.5, 0.6, -1.1}, 0.3)) +
                        dvec3(1.0) * (3.0 * soft_box(d, {0, 1, 0}, 0.5));
    return boxes * smooth(0.0, 0.1, d.y);
}

/// The room is of the ground's radiance at the horizon and below, and darker above.
double room(const dvec3& d) { return 1 - 0.55 * smooth(0.0, 0.8, d.y); }

/// A sky whose colours are near those of a clear one at 25 degrees of the sun's height, which stands for the
/// disc of a sun of a hundred times its size and the same irradiance.
dvec3 clear_sky(const dvec3& d) {
    const dvec3 sun = glm::normalize(dvec3(-0.75, 0.55, 0.7));
    const double toward = glm::dot(d, sun), up = std::max(d.y, 0.0);
    const dvec3 blue = glm::mix(dvec3(0.62, 0.72, 0.85), dvec3(0.16, 0.32, 0.66), std::pow(up, 0.45));
    const double glow = 0.6 * std::pow(std::max(toward, 0.0), 24.0);
    const double disc = smooth(std::cos(0.06), std::cos(0.045), toward);
    return blue + dvec3(1.0, 0.85, 0.62) * (glow + 900.0 * disc);
}

/// `lights` above a horizon whose radiance is that of the ground below them, times `base`.
EnvironmentMap map_above_ground(const Radiance& lights, const Radiance& base, double irradiance) {
    const dvec3 of_lights = irradiance_above(lights), of_base = irradiance_above(base);
    // The ground's radiance r = albedo / pi (of_lights + r of_base), solved for each channel.
    const dvec3 ground = ground_albedo / pi * of_lights / (1.0 - ground_albedo / pi * of_base);
    const double scale = irradiance / (of_lights + ground * of_base).y;
    return map_of([&](const dvec3& d) { return lights(d) + ground * base(d); }, scale);
}

}  // namespace

const char* name_of(Look look) {
    for (const auto& each : looks)
        if (each.look == look) return each.name;
    return "studio";
}

Look look_named(const std::string& name) {
    for (const auto& each : looks)
        if (each.name == name) return each.look;
    throw Error(Exit::usage, "--look " + name + ": there are studio, sky and white.");
}

void light(Scene& scene, Look look) {
    switch (look) {
        case Look::studio:
            scene.environment = map_above_ground(
                studio_boxes, [](const dvec3& d) { return dvec3(room(d)); }, pi);
            break;
        case Look::sky: {
            // Below the horizon lies what the ground reflects of the sky, whatever stands there.
            const auto above = [](const dvec3& d) { return d.y > 0 ? clear_sky(d) : dvec3(0.0); };
            const auto below = [](const dvec3& d) { return dvec3(d.y > 0 ? 0.0 : 1.0); };
            scene.environment = map_above_ground(above, below, 1.25 * pi);
            break;
        }
        case Look::white:
            scene.sky = vec3(1.0f);
            break;
    }
}

void stand_on_ground(Scene& scene) {
    const Bounds bounds = bounds_of(scene);
    if (bounds.empty()) return;
    const double size = std::max(bounds.radius(), 1e-6);
    Primitive disc;
    constexpr unsigned corners = 96;
    disc.positions.push_back(vec3(0.0f));
    for (unsigned i = 0; i < corners; ++i) {
        const double phi = 2 * pi * i / corners;
        disc.positions.push_back({float(std::cos(phi)), 0.0f, float(-std::sin(phi))});
        disc.triangles.push_back({0, 1 + i, 1 + (i + 1) % corners});
    }
    Material grey;
    grey.name = "ground", grey.base_colour = vec4(vec3(ground_albedo), 1), grey.metallic = 0,
    grey.roughness = 1;
    grey.specular = 0, grey.double_sided = true;
    disc.material = scene.materials.size();
    scene.materials.push_back(grey);
    scene.meshes.push_back({"ground", {std::move(disc)}});
    const dvec3 centre = bounds.centre();
    const dvec3 place(centre.x, bounds.lo.y - 1e-4 * size, centre.z);
    scene.instances.push_back({.name = "ground",
                               .mesh = scene.meshes.size() - 1,
                               .to_world = glm::scale(glm::translate(dmat4(1), place), dvec3(60 * size)),
                               .is_ground = true});
}

}  // namespace triad
