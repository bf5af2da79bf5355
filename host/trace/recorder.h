#pragma once
/// What single paths of a pixel did: the path tracer's own kernel, compiled so that it writes it down.
#include <cstdint>
#include <functional>
#include <vector>

#include "base/math.h"
#include "scene/film.h"
#include "trace/tracer.h"

namespace triad {

/// Where the end of an edge is. Radiance is what reaches the camera.
struct RecordedVertex {
    dvec3 position{0.0};         ///< world; the unit direction where the path left the scene
    std::uint32_t material = 0;  ///< of Scene::materials; TRIAD_NONE where the path left the scene
    std::uint32_t event = 0;     ///< BSDF_* bits of kernels/types.h: how the next direction was sampled
    std::uint32_t end = 0;       ///< PATH_* of kernels/types.h: why the path ends here
    vec3 found{0.0f};            ///< emission that the path hit here, or the environment
    vec3 direct{0.0f};           ///< light sampled here
    std::uint32_t found_source = 0,
                  direct_source = 0;  ///< of PackedScene::light_sources; TRIAD_NONE: nothing came
    vec3 throughput{0.0f};            ///< of what goes on, roulette included
    /// That ends here. It falls where the path goes back to the surface that parted its wavelengths, and on
    /// with another.
    unsigned edge = 1;
    float wavelength = 0;  ///< that the path came with, in nm; 0: all of them
};

struct RecordedPath {
    std::uint64_t sample = 0;
    unsigned bin = 0, half = 0;
    unsigned met = 0, rays = 0;  ///< vertices, over all wavelengths
    vec4 value{0.0f};            ///< radiance and alpha, as they enter the film
    std::vector<RecordedVertex>
        vertices;  ///< the first PATH_VERTICES; the last has what all later ones found
};

/// Receives the paths of samples [range) of the pixel (x, y) of the crop, vertex by vertex. The bits are
/// those that the tracer adds to the film.
void record_paths(Tracer& tracer, unsigned x, unsigned y, SampleRange range,
                  const std::function<void(const RecordedPath&)>& receive);

}  // namespace triad
