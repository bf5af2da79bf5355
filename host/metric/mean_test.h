#pragma once
/// Is the mean of some films the picture of a reference? Tile means, with variances known from the halves of
/// every pixel: a few films suffice, where Welch's t over whole pictures (statistics.h) needs dozens.
#include <string>
#include <vector>

#include "base/rgb_image.h"
#include "scene/film.h"

namespace triad {

/// Sums over tiles of what films show and of how uncertain that is.
struct TileMeans {
    static constexpr unsigned edge =
        16;  ///< of a tile in pixels; those at the right and bottom may be smaller
    struct Tile {
        double sum = 0;               ///< of the pixels' means
        double variance = 0;          ///< of that sum
        double variance_squares = 0;  ///< sum over pixels and films of the squares of what `variance` adds up
        std::size_t pixels = 0;
    };
    unsigned width = 0, height = 0, films = 0;
    double samples = 0;       ///< per pixel, over all films
    std::vector<Tile> tiles;  ///< [tile][channel], then the whole picture

    /// Adds a film; all of one size, with samples in both halves, independent of each other.
    void add(const Film& film);

    void begin(unsigned across, unsigned down);  ///< without a film
    void add(std::size_t pixel, unsigned channel, double mean, double variance);
};

/// Those of a picture of which no film is left: its noise, a relMSE, is spread over the pixels as relMSE
/// weighs them.
TileMeans tiles_of_picture(const RgbImage& picture, double relmse, double spp);

struct MeanTest {
    bool same = true;
    std::string sentence;  ///< the least probable tile, in numbers
};

/// Compares every tile of 16 x 16 pixels and the whole picture, channel by channel; together they call equal
/// pictures different with probability `family` (Sidak). A tile's mean has Student's t, with the degrees of
/// freedom that its variances' spread leaves (Satterthwaite). Light that one side has hardly found yet counts
/// with the other side's variance, scaled by samples. Throws std::invalid_argument for unequal sizes or no
/// films.
MeanTest test_means(const TileMeans& films, const TileMeans& reference, double family = 1e-6);

}  // namespace triad
