#include "scene/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/parallel_for.h"

namespace triad {
namespace {

std::string text(const SampleRange& range) {
    return std::to_string(range.begin) + ":" + std::to_string(range.end);
}

/// Throws when the parts are not of one picture, in words that say in what they differ.
void check_same_picture(const Film& a, const Film& b) {
    const auto differ = [](const std::string& what) {
        throw Error(Exit::scene, "The films cannot be merged: they differ in " + what + ".");
    };
    if (a.scene != b.scene) differ("their scene");
    if (a.full_width != b.full_width || a.full_height != b.full_height) differ("the size of the picture");
    if (a.x != b.x || a.y != b.y || a.width != b.width || a.height != b.height)
        differ("the crop that they cover");
    if (a.bins_x != b.bins_x || a.bins_y != b.bins_y) differ("their bins per pixel");
    if (a.quanta_log2 != b.quanta_log2) differ("their fixed-point quantum");
    if (a.settings != b.settings || a.settings_text != b.settings_text) differ("their settings");
}

/// Modulo 2^64: the quantum leaves room for every sum that fits, and order must not matter for those that do
/// not.
void add(std::vector<std::int64_t>& sums, const std::vector<std::int64_t>& more) {
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = std::int64_t(std::uint64_t(sums[i]) + std::uint64_t(more[i]));
}

/// The union of disjoint ranges: sorted, touching ones joined. Throws Error(incomplete) where two overlap.
std::vector<SampleRange> join(std::vector<SampleRange> ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::vector<SampleRange> joined;
    for (const SampleRange& range : ranges) {
        if (joined.empty() || range.begin > joined.back().end) {
            joined.push_back(range);
        } else if (range.begin == joined.back().end) {
            joined.back().end = range.end;
        } else {
            const SampleRange twice{range.begin, std::min(range.end, joined.back().end)};
            throw Error(Exit::incomplete,
                        "The films cannot be merged: samples " + text(twice) + " are in two of them.");
        }
    }
    return joined;
}

/// Samples of [0, n) that fall into the first half: sample s belongs to half (s / bins) & 1.
std::uint64_t first_half_below(std::uint64_t n, std::uint64_t bins) {
    return n / (2 * bins) * bins + std::min(n % (2 * bins), bins);
}

/// How many samples of a pixel fell into each half.
std::pair<std::uint64_t, std::uint64_t> half_counts(const Film& film) {
    std::uint64_t first = 0;
    for (const SampleRange& range : film.ranges)
        first += first_half_below(range.end, film.bins()) - first_half_below(range.begin, film.bins());
    return {first, film.sample_count() - first};
}

/// Of one channel of one pixel: its mean, and an unbiased estimate of that mean's variance.
struct Estimate {
    float mean, variance;
};

/// Halves of nA and nB samples with means A and B have Var(A - B) = s^2 (1/nA + 1/nB), and the mean of all
/// has s^2 / (nA + nB): so (A - B)^2 nA nB / (nA + nB)^2 is unbiased for it.
std::vector<Estimate> estimate_pixels(const Film& film, double first, double second) {
    std::vector<Estimate> estimates(film.pixels() * 3);
    const double count = first + second, weight = first / count * (second / count);
    parallel_for(film.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (film.samples[p] == 0) continue;
            const std::array<double, 4> mean = pixel_mean(film, p);
            const double unit = std::ldexp(1.0, -film.quanta_log2) * count / film.samples[p];
            for (std::size_t c = 0; c < 3; ++c) {
                const double a = double(film.half_sums[p * 3 + c]) * unit;  // nA A
                const double difference = a / first - (mean[c] * count - a) / second;
                estimates[p * 3 + c] = {float(mean[c]), float(weight * difference * difference)};
            }
        }
    });
    return estimates;
}

/// Sums over pixels: how many, their means, the squares of these, their variances.
struct Window {
    double pixels = 0, mean = 0, square = 0, variance = 0;

    void add(const Window& w, double sign = 1.0) {
        pixels += sign * w.pixels, mean += sign * w.mean, square += sign * w.square,
            variance += sign * w.variance;
    }
};

Window window_of(const Estimate& e) { return {1.0, e.mean, double(e.mean) * e.mean, e.variance}; }

/// 1 / (r^2 + .01), r the unknown true value. The pixel's own noisy mean will not do alone: it is correlated
/// with the variance estimate (where a bright path was found both are too high), which makes the error look
/// several times too small at few samples. Its neighbours' mean has independent noise, but other content. So
/// the two are blended as in Lee's local-statistics filter (1980): by the share of the neighbours' spread
/// that is content rather than noise.
double inverse_square(const Estimate& own, const Window& neighbours) {
    const double at_own = 1.0 / (double(own.mean) * own.mean + 0.01), n = neighbours.pixels;
    if (n < 2.0) return at_own;
    const double mean = neighbours.mean / n;
    const double spread = (neighbours.square - n * mean * mean) / (n - 1.0);
    const double content = std::max(0.0, spread - neighbours.variance / n);
    const double k = spread > 0.0 ? content / spread : 0.0;
    return k * at_own + (1.0 - k) / (mean * mean + 0.01);
}

/// Sum of variance / (r^2 + .01) over the pixels and channels of row y, neighbours taken from 5 x 5 pixels.
/// `columns`: room for a Window per pixel and channel.
double relmse_of_row(const Film& film, const std::vector<Estimate>& estimates, std::size_t y,
                     std::vector<Window>& columns) {
    constexpr std::size_t radius = 2;
    const std::size_t width = film.width, row = width * 3;
    std::fill(columns.begin(), columns.end(), Window{});
    for (std::size_t v = y - std::min(y, radius); v < std::min<std::size_t>(y + radius + 1, film.height); ++v)
        for (std::size_t i = 0; i < row; ++i) columns[i].add(window_of(estimates[v * row + i]));
    double sum = 0.0;
    for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
            const Estimate& own = estimates[y * row + x * 3 + c];
            Window neighbours;
            for (std::size_t u = x - std::min(x, radius); u < std::min(x + radius + 1, width); ++u)
                neighbours.add(columns[u * 3 + c]);
            neighbours.add(window_of(own), -1.0);
            sum += own.variance * inverse_square(own, neighbours);
        }
    return sum;
}

}  // namespace

std::uint64_t Film::sample_count() const {
    std::uint64_t count = 0;
    for (const SampleRange& range : ranges) count += range.end - range.begin;
    return count;
}

Film merge(std::span<const Film> parts) {
    if (parts.empty()) throw Error(Exit::usage, "There is nothing to merge: name at least one film.");
    Film whole = parts[0];
    std::vector<SampleRange> ranges = whole.ranges;
    for (const Film& part : parts.subspan(1)) {
        check_same_picture(whole, part);
        ranges.insert(ranges.end(), part.ranges.begin(), part.ranges.end());
    }
    whole.ranges = join(std::move(ranges));
    if (whole.sample_count() > std::numeric_limits<std::uint32_t>::max())
        throw Error(Exit::scene,
                    "The films cannot be merged: together they have more than 2^32 - 1 samples per pixel.");
    for (const Film& part : parts.subspan(1)) {
        add(whole.sums, part.sums);
        add(whole.half_sums, part.half_sums);
        for (std::size_t p = 0; p < whole.samples.size(); ++p) whole.samples[p] += part.samples[p];
        for (std::size_t c = 0; c < whole.counters.size(); ++c) whole.counters[c] += part.counters[c];
        whole.devices.insert(whole.devices.end(), part.devices.begin(), part.devices.end());
    }
    std::sort(whole.devices.begin(), whole.devices.end());
    whole.devices.erase(std::unique(whole.devices.begin(), whole.devices.end()), whole.devices.end());
    return whole;
}

std::vector<SampleRange> holes(const Film& film, std::uint64_t end) {
    std::vector<SampleRange> missing;
    std::uint64_t at = 0;
    for (const SampleRange& range : film.ranges) {
        if (at < std::min(range.begin, end)) missing.push_back({at, std::min(range.begin, end)});
        at = range.end;
    }
    if (at < end) missing.push_back({at, end});
    return missing;
}

std::array<double, 4> pixel_mean(const Film& film, std::size_t pixel) {
    std::array<double, 4> mean{};
    if (film.samples[pixel] == 0) return mean;
    for (std::size_t bin = 0; bin < film.bins(); ++bin)
        for (std::size_t c = 0; c < 4; ++c) mean[c] += double(film.sums[(pixel * film.bins() + bin) * 4 + c]);
    const double unit = std::ldexp(1.0, -film.quanta_log2) / film.samples[pixel];
    for (double& value : mean) value *= unit;
    return mean;
}

std::vector<float> mean_variance(const Film& film) {
    const auto [first, second] = half_counts(film);
    if (first == 0 || second == 0) return {};
    const std::vector<Estimate> estimates = estimate_pixels(film, double(first), double(second));
    std::vector<float> variance(estimates.size());
    for (std::size_t i = 0; i < variance.size(); ++i) variance[i] = estimates[i].variance;
    return variance;
}

double estimated_relmse(const Film& film) {
    const auto [first, second] = half_counts(film);
    if (first == 0 || second == 0 || film.pixels() == 0) return -1.0;
    const std::vector<Estimate> estimates = estimate_pixels(film, double(first), double(second));
    std::vector<double> row_sums(film.height);
    parallel_for(film.height, 8, [&](std::size_t begin, std::size_t end) {
        std::vector<Window> columns(std::size_t(film.width) * 3);
        for (std::size_t y = begin; y < end; ++y) row_sums[y] = relmse_of_row(film, estimates, y, columns);
    });
    double sum = 0.0;
    for (const double row : row_sums) sum += row;
    return sum / (3.0 * double(film.pixels()));
}

}  // namespace triad
