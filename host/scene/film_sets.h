#pragma once
/// The pixels of a film as work is given to them: tiles, and two sets in each, like the squares of a
/// chessboard.
#include <cstdint>
#include <vector>

#include "scene/film.h"

namespace triad {

/// Tiles of FILM_TILE pixels that cover a picture.
std::size_t tile_count(unsigned width, unsigned height);

/// Samples per pixel of set s of tile t, at [2 t + s]. Tiles of FILM_TILE pixels, row-major over the film's
/// crop; set s has the pixels with ((x ^ y) & 1) == s.
using SetSamples = std::vector<std::uint32_t>;

/// Pixels of each set: less than half a tile at the film's right and bottom edge, possibly none.
std::vector<std::uint32_t> set_pixels(unsigned width, unsigned height);

/// s of each set, summed over its pixels, from its own samples alone: with n samples per pixel it adds s / n
/// to the picture's error. Empty: not known yet.
using SetErrors = std::vector<double>;

}  // namespace triad
