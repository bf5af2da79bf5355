#pragma once
/// How sure a perceived error, and the difference of two, is: a bootstrap over tiles of the picture.
#include <cstdint>
#include <vector>

#include "panel/perceived.h"

namespace triad {

/// Squares of the perceived error, summed over tiles of a picture; pictures of one size have the same tiles.
struct TileErrors {
    std::vector<double> lightness, colour;  ///< sums of squares
    std::vector<double> samples;            ///< that were summed
};

/// Tiles of 8 px; a border of so many px is left out.
TileErrors tile_errors(const PerceivedError& error, unsigned samples_per_pixel, unsigned border);
/// Adds another picture of the same tiles: what comes out is of their mean square.
void add(TileErrors& sum, const TileErrors& more);

struct ErrorInterval {
    double value = 0, low = 0, high = 0;  ///< with its 95 % interval
};

/// Root of the mean square over all tiles: both parts together.
ErrorInterval error_interval(const TileErrors& tiles);
double root_mean(const std::vector<double>& squares, const std::vector<double>& samples);

/// Error of a less that of b; the tiles are drawn together, so that what both share drops out.
ErrorInterval difference_interval(const TileErrors& a, const TileErrors& b);

}  // namespace triad
