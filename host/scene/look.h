#pragma once
/// Light and ground for scenes that bring none, of our own making.
#include <string>

#include "scene/scene.h"

namespace triad {

enum class Look {
    studio,  ///< soft boxes in a dim room: a key from the left, a fill from the right, a rim behind, one
             ///< above
    sky,     ///< a clear sky with a low, softened sun
    white    ///< the same radiance, 1, from everywhere
};
const char* name_of(Look look);
/// Throws Error(usage).
Look look_named(const std::string& name);

/// Puts the scene into that light. What faces up receives irradiance pi of studio and white: white paper
/// there shows as white.
void light(Scene& scene, Look look);

/// Of studio and sky: radiance near the horizon is that of the ground, so that one passes into the other.
constexpr float ground_albedo = 0.5f;

/// A matte grey disc below all that is drawn, which catches its shadows. Nothing where nothing is drawn.
void stand_on_ground(Scene& scene);

}  // namespace triad
