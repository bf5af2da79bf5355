#include "scene/film_sets.h"

#include "kernels/types.h"

namespace triad {

std::size_t tile_count(unsigned width, unsigned height) {
    return std::size_t((width + FILM_TILE - 1) / FILM_TILE) * ((height + FILM_TILE - 1) / FILM_TILE);
}

std::vector<std::uint32_t> set_pixels(unsigned width, unsigned height) {
    const std::size_t across = (width + FILM_TILE - 1) / FILM_TILE;
    std::vector<std::uint32_t> pixels(2 * tile_count(width, height));
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            ++pixels[2 * (y / FILM_TILE * across + x / FILM_TILE) + ((x ^ y) & 1)];
    return pixels;
}

}  // namespace triad
