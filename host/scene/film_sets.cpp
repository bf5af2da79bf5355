#include "scene/film_sets.h"

#include "base/error.h"
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

SetSamples samples_of_sets(const Film& film) {
    constexpr std::uint32_t unknown = ~0u;
    const std::size_t across = (film.width + FILM_TILE - 1) / FILM_TILE;
    SetSamples sets(2 * tile_count(film.width, film.height), unknown);
    for (std::size_t y = 0; y < film.height; ++y)
        for (std::size_t x = 0; x < film.width; ++x) {
            std::uint32_t& set = sets[2 * (y / FILM_TILE * across + x / FILM_TILE) + ((x ^ y) & 1)];
            const std::uint32_t n = film.samples[y * film.width + x];
            if (set != unknown && set != n)
                throw Error(Exit::scene,
                            "The film cannot go on: pixels that are rendered together hold different numbers "
                            "of samples.");
            set = n;
        }
    for (std::size_t i = 0; i < sets.size(); ++i)
        if (sets[i] == unknown) sets[i] = sets[i ^ 1];
    return sets;
}

}  // namespace triad
