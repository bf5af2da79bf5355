#include "bench/ray_scenes.h"

#include <cmath>

#include "base/error.h"

namespace triad {
namespace {

/// The box with its front open, a light under the ceiling, two blocks: 36 triangles.
RayScene cornell() {
    RayScene scene{"cornell",    {},           {0.05f, 1.07f, 3.6f},
                   {0, 1, 0},    0.4f,         {-0.25f, 1.98f, -0.2f},
                   {0.5f, 0, 0}, {0, 0, 0.4f}, 4.0f};
    Primitive& m = scene.mesh;
    shapes::append(m, shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    shapes::append(m, shapes::quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}));
    shapes::append(m, shapes::quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}));
    shapes::append(m, shapes::quad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}));
    shapes::append(m, shapes::quad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}));
    shapes::append(m, shapes::quad({-0.25f, 1.99f, -0.2f}, {0.5f, 0, 0}, {0, 0, 0.4f}));
    const auto block = [&](const vec3& centre, const vec3& half, float angle) {
        Primitive box = shapes::box(-half, half);
        const float c = std::cos(angle), s = std::sin(angle);
        for (vec3& p : box.positions) p = centre + vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
        shapes::append(m, box);
    };
    block({0.35f, 0.3f, 0.35f}, {0.3f, 0.3f, 0.3f}, -0.3f);
    block({-0.35f, 0.6f, -0.3f}, {0.3f, 0.6f, 0.3f}, 0.3f);
    return scene;
}

/// A closed room with twelve displaced spheres around a high-polygon body.
RayScene room() {
    RayScene scene{"room", {}, {0, 2.2f, 4.6f}, {0, 1, 0}, 0.6f, {-1, 3.95f, -1}, {2, 0, 0}, {0, 0, 2}, 6.0f};
    Primitive& m = scene.mesh;
    shapes::append(m, shapes::box({-5, 0, -5}, {5, 4, 5}, true));
    shapes::append(m, shapes::displaced_sphere({0, 1.2f, 0}, 1.0f, 264, 133, 0.35f, 2.5f, 1));
    for (unsigned i = 0; i < 12; ++i) {
        const double phi = 2 * pi * i / 12;
        shapes::append(
            m, shapes::displaced_sphere(vec3(3.2 * std::cos(phi), 0.7 + 0.1 * (i % 3), 3.2 * std::sin(phi)),
                                        0.55f, 102, 51, 0.15f, 4.0f, 10 + i));
    }
    return scene;
}

/// Terrain with 2000 boulders under an open sky.
RayScene landscape() {
    RayScene scene{"landscape",       {},          {0, 60, 420}, {0, 0, 0}, 0.5f,
                   {-100, 400, -100}, {200, 0, 0}, {0, 0, 200},  600.0f};
    Primitive& m = scene.mesh;
    m = shapes::terrain(1000.0f, 60.0f, 700, 1);
    const auto height_at = [&, count = 701u](unsigned column, unsigned row) {
        return m.positions[row * count + column];
    };
    std::vector<vec3> places;
    std::uint32_t state = 12345;
    const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    for (unsigned i = 0; i < 2000; ++i) {
        const unsigned column = next() % 701u, row = next() % 701u;
        places.push_back(height_at(column, row));
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        shapes::append(m, shapes::displaced_sphere(places[i], 1.0f + float(next() % 5000u) * 1e-3f, 16, 17,
                                                   0.3f, 1.5f, unsigned(i)));
    return scene;
}

}  // namespace

RayScene make_ray_scene(const std::string& name) {
    if (name == "cornell") return cornell();
    if (name == "room") return room();
    if (name == "landscape") return landscape();
    throw Error(Exit::usage,
                "There is no benchmark scene '" + name + "'; there are cornell, room and landscape.");
}

}  // namespace triad
