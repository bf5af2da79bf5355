#include "render/adaptive.h"

#include <algorithm>
#include <cmath>

#include "kernels/types.h"

namespace triad {
namespace {

/// No set is left with less than this share of the mean: what has not been found yet must be looked for
/// everywhere.
constexpr double least_share = 0.25;
/// No set grows by more than this in a round: an estimate from few samples must not draw all of them.
constexpr double most_growth = 4.0;
/// Weights of a tile, of its neighbours by an edge, and by a corner, when a set's error is estimated.
constexpr double weights[3] = {4.0, 1.0, 0.5};

struct Tiles {
    std::size_t across, down;
    explicit Tiles(unsigned width, unsigned height)
        : across((width + FILM_TILE - 1) / FILM_TILE), down((height + FILM_TILE - 1) / FILM_TILE) {}
};

/// Per set: the mean s of a pixel as the other sets of its tile and of the tiles around show it.
std::vector<double> seen_by_others(const Tiles& tiles, const SetErrors& s,
                                   const std::vector<std::uint32_t>& pixels) {
    std::vector<double> seen(s.size());
    for (std::size_t y = 0; y < tiles.down; ++y)
        for (std::size_t x = 0; x < tiles.across; ++x)
            for (std::size_t set = 0; set < 2; ++set) {
                double sum = 0, weight = 0;
                for (std::size_t v = y - (y > 0); v < std::min(y + 2, tiles.down); ++v)
                    for (std::size_t u = x - (x > 0); u < std::min(x + 2, tiles.across); ++u) {
                        const std::size_t other = 2 * (v * tiles.across + u) + (1 - set);
                        const double w = weights[(v != y) + (u != x)];
                        sum += w * s[other], weight += w * pixels[other];
                    }
                seen[2 * (y * tiles.across + x) + set] = weight > 0 ? sum / weight : 0.0;
            }
    return seen;
}

}  // namespace

SetErrors relmse_of_sets(const Film& film, std::span<const float> errors, const SetSamples& have) {
    if (errors.empty()) return {};
    const Tiles tiles(film.width, film.height);
    SetErrors result(have.size());
    for (std::size_t y = 0; y < film.height; ++y)
        for (std::size_t x = 0; x < film.width; ++x)
            result[2 * (y / FILM_TILE * tiles.across + x / FILM_TILE) + ((x ^ y) & 1)] +=
                errors[y * film.width + x];
    for (std::size_t i = 0; i < have.size(); ++i) result[i] *= have[i];
    return result;
}

SetSamples distribute(unsigned width, unsigned height, const SetErrors& errors, const SetSamples& have,
                      double mean, unsigned step) {
    const std::vector<std::uint32_t> pixels = set_pixels(width, height);
    std::vector<double> share = seen_by_others(Tiles(width, height), errors, pixels);
    for (double& s : share) s = std::sqrt(s);
    const auto wanted = [&](std::size_t i, double scale) {
        const double least = std::max(double(have[i]), least_share * mean);
        return std::clamp(scale * share[i], least, std::max(least, most_growth * have[i]));
    };
    // Each colour of the chessboard has its own budget: shared, a set's own samples would decide by way of
    // the sum.
    SetSamples result = have;
    for (std::size_t colour = 0; colour < 2; ++colour) {
        const auto excess = [&](double scale) {
            double sum = 0;
            for (std::size_t i = colour; i < have.size(); i += 2)
                sum += pixels[i] * (wanted(i, scale) - mean);
            return sum;
        };
        // Bisection on the logarithm of the scale, over more than any film's range.
        double low = -100, high = 100;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (excess(std::exp2(middle)) < 0 ? low : high) = middle;
        }
        // What rounding to steps leaves over goes on to the next set.
        double carry = 0;
        for (std::size_t i = colour; i < have.size(); i += 2) {
            if (pixels[i] == 0) continue;
            carry += pixels[i] * (wanted(i, std::exp2(low)) - have[i]);
            const double steps = std::max(0.0, std::floor(carry / (pixels[i] * step) + 0.5));
            result[i] += static_cast<std::uint32_t>(steps) * step;
            carry -= steps * step * pixels[i];
        }
    }
    if (result == have) {  // less than a step for every set: the noisiest gets one
        std::size_t noisiest = 0;
        for (std::size_t i = 1; i < have.size(); ++i)
            if (pixels[i] > 0 && share[i] > share[noisiest]) noisiest = i;
        result[noisiest] += step;
    }
    return result;
}

}  // namespace triad
