#pragma once
/// The pixels of a film as work is given to them: tiles, and two sets in each, like the squares of a
/// chessboard.
#include <cstdint>
#include <string>
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

/// What each set of a film holds, a set without pixels as much as the other of its tile. Throws Error(scene)
/// when the pixels of one hold different numbers.
SetSamples samples_of_sets(const Film& film);

/// s of each set, summed over its pixels, from its own samples alone: with n samples per pixel it adds s / n
/// to the picture's error. Empty: not known yet.
using SetErrors = std::vector<double>;

/// Finds the errors of sets from how a film grows.
class SetErrorSource {
  public:
    virtual ~SetErrorSource() = default;
    /// `have`: samples of each set. Empty the first time.
    virtual SetErrors of(const Film& film, const SetSamples& have) = 0;
    /// All that it remembers, as bytes that another one of the same picture goes on from.
    virtual std::string kept() const = 0;
    /// Throws Error(scene) when these are no such bytes.
    virtual void go_on_from(const std::string& kept) = 0;
};

}  // namespace triad
