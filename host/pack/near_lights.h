#pragma once
/// Which triangle lights are drawn by solid angle (kernels/shading/near_light.h), and from where.
namespace triad {

struct PackedScene;
struct Scene;

/// Sets `range` of triangle lights where much of the scene's light is reflected near its lamps. But for
/// rounding it follows from the scene alone, not from the eye. After picks are known.
void mark_near_lights(const Scene& scene, PackedScene& packed);

}  // namespace triad
