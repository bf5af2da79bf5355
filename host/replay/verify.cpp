#include "replay/verify.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "base/text.h"
#include "kernels/types.h"

namespace triad {
namespace {

using What = CapturedArray::What;

/// Of the mean of the picture: what is darker than this share of it counts as if it were as bright.
constexpr double floor_share = 0.01;

/// Arrays of one kind, of all bands, as one.
template <class T, class ContentOf>
std::vector<T> joined(const Capture& capture, What what, const ContentOf& content_of) {
    std::vector<T> all;
    for (std::size_t i = 0; i < capture.film.size(); ++i) {
        if (capture.film[i].what != what) continue;
        const AlignedVector<std::byte>& content = content_of(i);
        const std::size_t before = all.size();
        all.resize(before + content.size() / sizeof(T));
        if (!content.empty()) std::memcpy(all.data() + before, content.data(), content.size());
    }
    return all;
}

/// R, G and B.
struct Colours {
    double c[3] = {};
};

/// Both films' colours of bins, or of anything that bins add up to.
struct Both {
    std::vector<Colours> captured, replayed;
};

Colours mean_of(const std::vector<Colours>& all) {
    Colours mean;
    for (const Colours& each : all)
        for (int c = 0; c < 3; ++c) mean.c[c] += std::abs(each.c[c]) / double(all.size());
    return mean;
}

/// The largest of three relative differences, by place.
std::vector<double> relative_differences(const Both& both) {
    const Colours mean = mean_of(both.captured);
    std::vector<double> all;
    for (std::size_t i = 0; i < both.captured.size(); ++i) {
        double largest = 0;
        for (int c = 0; c < 3; ++c) {
            const double a = both.captured[i].c[c], b = both.replayed[i].c[c],
                         floor = std::abs(a) + floor_share * mean.c[c];
            if (a != b) largest = std::max(largest, floor > 0 ? std::abs(b - a) / floor : 1.0);
        }
        all.push_back(largest);
    }
    return all;
}

double sum(const Colours& c) { return c.c[0] + c.c[1] + c.c[2]; }

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Sets the bias, and what chance explains of it: four standard errors of a median, whose deviation is taken
/// from the median of the distances from it, of a normal distribution.
void set_bias(const Both& tiles, FilmDifference& d) {
    const double floor = floor_share * sum(mean_of(tiles.captured));
    std::vector<double> all;
    for (std::size_t i = 0; i < tiles.captured.size(); ++i) {
        const double a = sum(tiles.captured[i]), b = sum(tiles.replayed[i]);
        if (a != 0 || b != 0) all.push_back((b - a) / (std::abs(a) + floor));
    }
    if (all.empty()) return;
    d.bias = median_of(all);
    for (double& value : all) value = std::abs(value - d.bias);
    d.chance_bias = 4 * 1.2533 * 1.4826 * median_of(all) / std::sqrt(double(all.size()));
}

std::uint64_t beyond(const std::vector<double>& values, double bound) {
    return std::uint64_t(std::count_if(values.begin(), values.end(), [&](double v) { return v > bound; }));
}

Both tiles_of(const Capture& capture, const Both& bins) {
    const std::uint64_t across = (capture.width + FILM_TILE - 1) / FILM_TILE,
                        down = (capture.height + FILM_TILE - 1) / FILM_TILE;
    Both tiles{std::vector<Colours>(across * down), std::vector<Colours>(across * down)};
    for (std::uint64_t y = 0; y < capture.height; ++y)
        for (std::uint64_t x = 0; x < capture.width; ++x)
            for (std::uint64_t bin = 0; bin < capture.bins; ++bin) {
                const std::uint64_t from = (y * capture.width + x) * capture.bins + bin,
                                    to = y / FILM_TILE * across + x / FILM_TILE;
                for (int c = 0; c < 3; ++c) {
                    tiles.captured[to].c[c] += bins.captured[from].c[c];
                    tiles.replayed[to].c[c] += bins.replayed[from].c[c];
                }
            }
    return tiles;
}

std::vector<Colours> colours_of(const std::vector<std::int64_t>& sums) {
    std::vector<Colours> all(sums.size() / FILM_CHANNELS);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) all[i].c[c] = double(sums[i * FILM_CHANNELS + c]);
    return all;
}

double rays_of(const std::vector<std::uint32_t>& counters) {
    return double(counters[2 * COUNTER_RAYS]) + std::ldexp(double(counters[2 * COUNTER_RAYS + 1]), 32);
}

std::string share_text(std::uint64_t part, std::uint64_t all) {
    return format("%.3g %%", 100 * double(part) / double(all));
}

}  // namespace

FilmDifference difference(const Capture& capture, const ReplayedFilm& film) {
    FilmDifference d;
    d.same_bits = true;
    for (std::size_t i = 0; i < film.size(); ++i) d.same_bits &= film[i] == *capture.film[i].content;
    const auto captured = [&](std::size_t i) -> const AlignedVector<std::byte>& {
        return *capture.film[i].content;
    };
    const auto replayed = [&](std::size_t i) -> const AlignedVector<std::byte>& { return film[i]; };
    const auto samples = joined<std::uint32_t>(capture, What::samples, captured),
               own_samples = joined<std::uint32_t>(capture, What::samples, replayed);
    d.pixels = samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i)
        d.pixels_with_other_samples += samples[i] != own_samples[i];
    const Both bins{colours_of(joined<std::int64_t>(capture, What::sums, captured)),
                    colours_of(joined<std::int64_t>(capture, What::sums, replayed))};
    d.bins = bins.captured.size();
    d.samples_per_bin = std::accumulate(samples.begin(), samples.end(), 0.0) / double(d.bins);
    d.bins_off = beyond(relative_differences(bins), FilmDifference::bin_tolerance);
    const Both tiles = tiles_of(capture, bins);
    const std::vector<double> differences = relative_differences(tiles);
    d.tiles = differences.size();
    d.tiles_off = beyond(differences, FilmDifference::tile_tolerance);
    d.largest_tile = *std::max_element(differences.begin(), differences.end());
    set_bias(tiles, d);
    d.captured_rays = rays_of(joined<std::uint32_t>(capture, What::counters, captured));
    d.rays = rays_of(joined<std::uint32_t>(capture, What::counters, replayed));
    return d;
}

double FilmDifference::bins_that_may_be_off() const {
    return 1 - std::pow(1 - most_samples_astray, std::max(samples_per_bin, 1.0));
}

std::string FilmDifference::why_not() const {
    std::string why;
    const auto unless = [&](bool ok, const std::string& phrase) {
        if (!ok) why += (why.empty() ? "" : "; ") + phrase;
    };
    unless(pixels_with_other_samples == 0,
           share_text(pixels_with_other_samples, pixels) + " of the pixels have other numbers of samples");
    unless(double(bins_off) <= std::ceil(bins_that_may_be_off() * double(bins)),
           share_text(bins_off, bins) + format(" of the bins differ by more than %.3g %%, which %.3g %% may",
                                               100 * bin_tolerance, 100 * bins_that_may_be_off()));
    unless(
        double(tiles_off) <= std::ceil(most_tiles_off * double(tiles)),
        share_text(tiles_off, tiles) + format(" of the tiles differ by more than %.3g %%, which %.3g %% may",
                                              100 * tile_tolerance, 100 * most_tiles_off));
    unless(std::abs(bias) <= most_bias + chance_bias,
           format("tiles are %.3g %% %s in the median, which may be %.3g %%", 100 * std::abs(bias),
                  bias > 0 ? "brighter" : "darker", 100 * (most_bias + chance_bias)));
    unless(std::abs(rays - captured_rays) <= most_rays * captured_rays + spare_rays,
           format("the number of rays differs by %.3g %%, which may be %.3g %%", 100 * relative_rays(),
                  100 * most_rays));
    return why;
}

bool is_captured_device(const CaptureOrigin& origin, const Device& device) {
    const DeviceInfo& info = device.info();
    return origin.device == info.name && origin.driver == info.driver && origin.platform == info.platform &&
           origin.platform_version == device.platform_version();
}

Verification judge(const Capture& capture, const Device& device, const ReplayedFilm& film, VerifyRule rule) {
    Verification v;
    v.difference = difference(capture, film);
    v.by_bits = rule == VerifyRule::bits ||
                (rule == VerifyRule::automatic && is_captured_device(capture.origin, device));
    const std::string why = v.difference.why_not();
    v.ok = v.difference.same_bits || (!v.by_bits && why.empty());
    const std::string numbers =
        share_text(v.difference.bins_off, v.difference.bins) +
        format(" of the bins differ by more than %.3g %%, ", 100 * FilmDifference::bin_tolerance) +
        share_text(v.difference.tiles_off, v.difference.tiles) +
        format(" of the tiles by more than %.3g %%, the most by %.3g %%; in the median %.3g %%, rays %.3g %%",
               100 * FilmDifference::tile_tolerance, 100 * v.difference.largest_tile, 100 * v.difference.bias,
               100 * v.difference.relative_rays());
    if (v.difference.same_bits)
        v.sentence = "Verified: the film has the captured bits";
    else if (v.ok)
        v.sentence = "Verified: the film agrees with the captured one: " + numbers;
    else if (v.by_bits)
        v.sentence = "Not verified: the film has other bits than the captured one (" +
                     (why.empty() ? "though it agrees with it" : why) + "): " + numbers;
    else
        v.sentence = "Not verified: " + why + ". " + numbers;
    v.sentence += ".";
    return v;
}

Json to_json(const Verification& v) {
    const FilmDifference& d = v.difference;
    return {{"rule", v.by_bits ? "bits" : "film"},
            {"ok", v.ok},
            {"same_bits", d.same_bits},
            {"pixels_with_other_samples", d.pixels_with_other_samples},
            {"bins", d.bins},
            {"bins_off", d.bins_off},
            {"tiles", d.tiles},
            {"tiles_off", d.tiles_off},
            {"largest_tile", d.largest_tile},
            {"bias", d.bias},
            {"chance_bias", d.chance_bias},
            {"rays", d.rays},
            {"captured_rays", d.captured_rays},
            {"sentence", v.sentence}};
}

}  // namespace triad
