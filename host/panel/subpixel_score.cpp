#include "panel/subpixel_score.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace triad {
namespace {

constexpr unsigned tile_px = 8;
constexpr unsigned draws = 1000;

/// The statistic of 1000 drawings of as many tiles, with the same seed for all, and of the tiles themselves.
ErrorInterval bootstrap(std::size_t tiles,
                        const std::function<double(const std::vector<std::size_t>&)>& statistic) {
    std::vector<std::size_t> chosen(tiles);
    for (std::size_t i = 0; i < tiles; ++i) chosen[i] = i;
    ErrorInterval result;
    result.value = statistic(chosen);
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> any(0, tiles - 1);
    std::vector<double> values;
    for (unsigned draw = 0; draw < draws; ++draw) {
        for (std::size_t& tile : chosen) tile = any(random);
        values.push_back(statistic(chosen));
    }
    std::sort(values.begin(), values.end());
    result.low = values[draws * 25 / 1000], result.high = values[draws * 975 / 1000 - 1];
    return result;
}

double error_of(const TileErrors& t, const std::vector<std::size_t>& chosen) {
    double squares = 0, samples = 0;
    for (const std::size_t i : chosen) squares += t.lightness[i] + t.colour[i], samples += t.samples[i];
    return std::sqrt(squares / samples);
}

}  // namespace

TileErrors tile_errors(const PerceivedError& error, unsigned samples, unsigned border) {
    const unsigned w = error.map.width / samples, h = error.map.height / samples;
    const unsigned columns = (w - 2 * border + tile_px - 1) / tile_px,
                   rows = (h - 2 * border + tile_px - 1) / tile_px;
    TileErrors tiles;
    tiles.lightness.resize(std::size_t(columns) * rows);
    tiles.colour = tiles.samples = tiles.lightness;
    for (unsigned y = border * samples; y < (h - border) * samples; ++y)
        for (unsigned x = border * samples; x < (w - border) * samples; ++x) {
            const float* d = error.map.rgb.data() + (std::size_t(y) * error.map.width + x) * 3;
            const std::size_t tile =
                std::size_t((y / samples - border) / tile_px) * columns + (x / samples - border) / tile_px;
            tiles.lightness[tile] += double(d[0]) * d[0];
            tiles.colour[tile] += double(d[1]) * d[1] + double(d[2]) * d[2];
            tiles.samples[tile] += 1;
        }
    return tiles;
}

void add(TileErrors& sum, const TileErrors& more) {
    if (sum.samples.empty())
        sum = more;
    else if (sum.samples.size() != more.samples.size())
        throw std::invalid_argument("pictures of one size have the same tiles");
    else
        for (std::size_t i = 0; i < sum.samples.size(); ++i) {
            sum.lightness[i] += more.lightness[i];
            sum.colour[i] += more.colour[i];
            sum.samples[i] += more.samples[i];
        }
}

double root_mean(const std::vector<double>& squares, const std::vector<double>& samples) {
    double s = 0, n = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) s += squares[i], n += samples[i];
    return std::sqrt(s / n);
}

ErrorInterval error_interval(const TileErrors& tiles) {
    return bootstrap(tiles.samples.size(), [&](const auto& chosen) { return error_of(tiles, chosen); });
}

ErrorInterval difference_interval(const TileErrors& a, const TileErrors& b) {
    if (a.samples.size() != b.samples.size())
        throw std::invalid_argument("pictures of one size have the same tiles");
    return bootstrap(a.samples.size(),
                     [&](const auto& chosen) { return error_of(a, chosen) - error_of(b, chosen); });
}

}  // namespace triad
