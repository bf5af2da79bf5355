#include "pack/texture_levels.h"

#include <algorithm>
#include <set>

#include "scene/image_reduce.h"

namespace triad {
namespace {

/// Images of fewer texels stay in the caches, and pictures rarely see them smaller than they are.
constexpr std::size_t least_texels = 128 * 128;

}  // namespace

bool may_have_levels(const Material& material) { return material.alpha_mode == AlphaMode::opaque; }

std::vector<uvec2> level_sizes(const Image& image) {
    std::vector<uvec2> sizes;
    uvec2 size = {image.width, image.height};
    if (std::size_t(size.x) * size.y < least_texels) return sizes;
    while (const unsigned side = std::max(size.x, size.y) / 2)
        sizes.push_back(size = reduced_size(size.x, size.y, side));
    return sizes;
}

std::uint64_t level_bytes(const Scene& scene) {
    std::set<std::size_t> images;
    for (const Material& m : scene.materials)
        if (may_have_levels(m))
            for (const TextureUse* use : colour_uses_of(m)) images.insert(scene.textures[use->texture].image);
    std::uint64_t bytes = 0;
    for (const std::size_t i : images)
        for (const uvec2& size : level_sizes(scene.images[i]))
            bytes += std::uint64_t(size.x) * size.y * 4 * (scene.images[i].bits / 8);
    return bytes;
}

}  // namespace triad
