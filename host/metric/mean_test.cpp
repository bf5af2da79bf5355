#include "metric/mean_test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "metric/statistics.h"

namespace triad {
namespace {

constexpr unsigned tile_edge = TileMeans::edge;
constexpr double rounding = 1e-6;  // standard error of a mean from rounding, relative to it

unsigned tiles_along(unsigned pixels) { return (pixels + tile_edge - 1) / tile_edge; }

/// Variance of a tile's mean, and how many degrees of freedom that estimate has. A variance from two halves
/// has one, so that E[v^2] = 3 E[v]^2.
struct Doubt {
    double variance, dof;
};
Doubt doubt_of(const TileMeans::Tile& tile, double films) {
    const double n = films * double(tile.pixels);
    return {tile.variance / (n * n), tile.variance_squares > 0
                                         ? 3 * tile.variance * tile.variance / tile.variance_squares
                                         : std::numeric_limits<double>::infinity()};
}

}  // namespace

void TileMeans::begin(unsigned across, unsigned down) {
    width = across, height = down;
    tiles.resize((std::size_t(tiles_along(width)) * tiles_along(height) + 1) * 3);
}

void TileMeans::add(std::size_t pixel, unsigned channel, double mean, double variance) {
    const std::size_t x = pixel % width, y = pixel / width;
    const std::size_t tile = y / tile_edge * tiles_along(width) + x / tile_edge;
    for (Tile* t : {&tiles[tile * 3 + channel], &tiles[tiles.size() - 3 + channel]}) {
        t->sum += mean, t->variance += variance, t->variance_squares += variance * variance;
        t->pixels += films == 1;
    }
}

void TileMeans::add(const Film& film) {
    if (films == 0) begin(film.width, film.height);
    const std::vector<float> variance = mean_variance(film);
    if (film.width != width || film.height != height || variance.empty())
        throw std::invalid_argument("films to compare must have one size and samples in both halves");
    ++films;
    samples += film.sample_numbers().mean;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const auto mean = pixel_mean(film, p);
        for (unsigned c = 0; c < 3; ++c) add(p, c, mean[c], variance[3 * p + c]);
    }
}

TileMeans tiles_of_picture(const RgbImage& picture, double relmse, double spp) {
    TileMeans means;
    means.begin(picture.width, picture.height);
    means.films = 1, means.samples = spp;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double r = picture.rgb[i];
        means.add(i / 3, i % 3, r, relmse * (r * r + 0.01));
    }
    return means;
}

MeanTest test_means(const TileMeans& films, const TileMeans& reference, double family) {
    if (films.films == 0 || reference.films == 0 || films.width != reference.width ||
        films.height != reference.height)
        throw std::invalid_argument("films to compare must have one size");
    const double limit = sidak(family, films.tiles.size());
    const double ratio = films.samples / reference.samples;
    MeanTest test;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < films.tiles.size(); ++i) {
        const TileMeans::Tile &f = films.tiles[i], &r = reference.tiles[i];
        Doubt a = doubt_of(f, films.films), b = doubt_of(r, reference.films);
        if (a.variance < b.variance / ratio) a = {b.variance / ratio, b.dof};
        if (b.variance < a.variance * ratio) b = {a.variance * ratio, a.dof};
        const double x = f.sum / (double(f.pixels) * films.films),
                     y = r.sum / (double(r.pixels) * reference.films);
        const double known = rounding * rounding * (x * x + y * y), all = a.variance + b.variance + known;
        const double doubt = a.variance * a.variance / a.dof + b.variance * b.variance / b.dof;
        const double dof = doubt > 0 ? all * all / doubt : std::numeric_limits<double>::infinity();
        const double t = x == y ? 0 : (x - y) / std::sqrt(all);
        const double p = std::isfinite(all) && std::isfinite(t) ? student_t_tail(t, dof) : 0;
        if (!(p < least)) continue;
        least = p;
        const std::size_t tile = i / 3, across = tiles_along(films.width);
        const std::string place = i + 3 >= films.tiles.size() ? "the whole picture"
                                                              : "tile " + std::to_string(tile % across) +
                                                                    ", " + std::to_string(tile / across);
        char text[300];
        std::snprintf(text, sizeof text,
                      "%s the reference's picture; least probable: %s, channel %c, mean %.6g instead of %.6g "
                      "(%+.3g %%), p = %.2g of %zu comparisons",
                      p < limit ? "Not" : "It is", place.c_str(), "RGB"[i % 3], x, y, 100 * (x / y - 1), p,
                      films.tiles.size());
        test.sentence = text;
    }
    test.same = least >= limit;
    return test;
}

}  // namespace triad
