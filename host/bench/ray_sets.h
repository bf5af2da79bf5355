#pragma once
/// Rays as a path tracer asks for them: those of the camera lie side by side, those that surfaces scatter do
/// not, and those to a light end before it. The same rays on every machine whose hits are the same.
#include <vector>

#include "bench/ray_scenes.h"
#include "bvh/bvh.h"

namespace triad {

/// One ray per pixel of size x size, in tiles of 8 x 8, and in these in blocks of 4 x 2.
std::vector<dev::Ray> primary_rays(const RayScene& scene, unsigned size);

/// Where a ray hit, a little before the surface, so that a tracer which cannot skip a triangle sees the same
/// scene.
struct RayEnd {
    vec3 position, normal;
    std::uint32_t primitive;
};
std::vector<RayEnd> ends_of(const RayScene& scene, const std::vector<dev::Ray>& rays,
                            const std::vector<dev::Hit>& hits);

/// A cosine-distributed direction from every point.
std::vector<dev::Ray> diffuse_rays(const std::vector<RayEnd>& points);

/// To a random point of the light, where the surface faces it; the segment ends a little before it.
std::vector<dev::Ray> shadow_rays(const RayScene& scene, const std::vector<RayEnd>& points);

}  // namespace triad
