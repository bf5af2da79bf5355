#include "pack/texture_levels.h"

#include <algorithm>
#include <set>

#include "scene/image_reduce.h"

namespace triad {
namespace {

/// Images of fewer texels stay in the caches, and pictures rarely see them smaller than they are.
constexpr std::size_t least_texels = 128 * 128;

}  // namespace

bool may_have_levels(const Image& image) { return std::size_t(image.width) * image.height >= least_texels; }

bool may_have_levels(const Material& material) { return material.alpha_mode == AlphaMode::opaque; }

std::uint64_t level_bytes(const Scene& scene) {
    std::set<std::size_t> images;
    for (const Material& m : scene.materials) {
        if (!may_have_levels(m)) continue;
        for (const std::optional<TextureUse>& use :
             {m.base_colour_texture, m.emission_texture, m.specular_colour_texture,
              m.sheen ? m.sheen->colour_texture : std::nullopt,
              m.diffuse_transmission ? m.diffuse_transmission->colour_texture : std::nullopt})
            if (use) images.insert(scene.textures[use->texture].image);
    }
    std::uint64_t bytes = 0;
    for (const std::size_t i : images) {
        const Image& image = scene.images[i];
        uvec2 size = {image.width, image.height};
        while (may_have_levels(image) && std::max(size.x, size.y) > 1) {
            size = reduced_size(size.x, size.y, std::max(size.x, size.y) / 2);
            bytes += std::uint64_t(size.x) * size.y * 4 * (image.bits / 8);
        }
    }
    return bytes;
}

}  // namespace triad
