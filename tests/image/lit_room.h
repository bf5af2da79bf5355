#pragma once
/// A small scene with all kinds of noise.
#include <vector>

#include "../analytic/analytic_scene.h"

namespace triad::analytic {

/// A room corner with a glossy block, under a sky and a square light cut into cells x cells.
inline Scene lit_room(unsigned cells, bool sky_as_map) {
    Builder b;
    Material wall;
    wall.metallic = 0.0f, wall.roughness = 0.6f;
    wall.base_colour = {0.7f, 0.6f, 0.4f, 1.0f};
    Material metal;
    metal.roughness = 0.4f;
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), wall);
    b.add(shapes::quad({-2, 0, -1}, {4, 0, 0}, {0, 3, 0}), wall);
    b.add(shapes::box({-0.5f, 0, -0.5f}, {0.3f, 0.8f, 0.3f}), metal);
    b.add(shapes::quad({-0.6f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, cells, cells), emitter(4.0f));
    const float radiance = 0.25f;
    if (sky_as_map)
        b.scene.environment = EnvironmentMap{16, 8, std::vector<float>(16 * 8 * 3, radiance)};
    else
        b.sky(radiance);
    return b.scene;
}

inline View room_view() { return look_at({0.8, 1.3, 3.2}, {0, 0.6, 0}, 0.8, 1.0); }

}  // namespace triad::analytic
