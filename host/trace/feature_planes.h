#pragma once
/// What the camera sees first, without noise of light: planes beside the picture.
#include <vector>

#include "trace/tracer.h"

namespace triad {

/// Floats per pixel: albedo (3), shading normal (3, world), position (3, world), depth (1, along the view).
struct FeaturePlanes {
    std::vector<float> albedo, normal, position, depth;
};

/// Means over the given number of samples of the same paths that the tracer adds to the film.
FeaturePlanes feature_planes(Tracer& tracer, unsigned samples);

}  // namespace triad
