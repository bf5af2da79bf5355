#pragma once
/// Levels of textures: smaller and smaller means of an image, for lookups that stand for many texels
/// (docs/shading.md, "Textures"). Made by pack_materials().
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace triad {

/// Whether means of its colours are the colours of many of its points: not where coverage leaves some out.
bool may_have_levels(const Material& material);

/// Sizes of an image's levels: each half as long as the one before, down to one texel; none of a small image.
std::vector<uvec2> level_sizes(const Image& image);
/// What the levels of a scene's textures take, packed.
std::uint64_t level_bytes(const Scene& scene);

}  // namespace triad
