#pragma once
/// Three scenes to trace rays in, and the camera and light that rays come from and go to.
#include <string>
#include <vector>

#include "scene/shapes.h"

namespace triad {

struct RayScene {
    std::string name;
    Primitive mesh;
    vec3 eye, target;
    float half_height;             ///< of the image plane at distance 1
    vec3 light, light_u, light_v;  ///< corner and edges of the area light that shadow rays go to
    float reach;                   ///< largest coordinate of a ray origin
};

/// "cornell" (36 triangles), "room" (0.2 million, closed) or "landscape" (2 million, open sky).
RayScene make_ray_scene(const std::string& name);

}  // namespace triad
