/// The error of a film, from its two halves.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel_for.h"
#include "scene/film.h"

namespace triad {
namespace {

/// Samples of [0, n) that fall into the first half: sample s belongs to half (s / bins) & 1.
std::uint64_t first_half_below(std::uint64_t n, std::uint64_t bins) {
    return n / (2 * bins) * bins + std::min(n % (2 * bins), bins);
}

/// How many samples of a pixel fell into each half.
class HalfCounts {
  public:
    explicit HalfCounts(const Film& film) : bins_(film.bins()), common_(film.sample_count()) {
        for (const SampleRange& range : film.ranges)
            first_ += first_half_below(range.end, bins_) - first_half_below(range.begin, bins_);
        if (!film.ranges.empty()) end_ = film.ranges.back().end;
    }

    /// Every pixel has samples in both.
    bool known() const { return first_ > 0 && common_ > first_; }

    /// Of a pixel that holds `samples`.
    double first(std::uint64_t samples) const {
        const std::uint64_t more = samples - std::min(samples, common_);
        return double(first_ + first_half_below(end_ + more, bins_) - first_half_below(end_, bins_));
    }

  private:
    std::uint64_t bins_, common_, first_ = 0, end_ = 0;
};

/// Of one channel of one pixel: its mean, an unbiased estimate of that mean's variance, and the mean of its
/// darker half.
struct Estimate {
    float mean = 0, variance = 0, darker = 0;
};

/// Halves of nA and nB samples with means A and B have Var(A - B) = s^2 (1/nA + 1/nB), and the mean of all
/// has s^2 / (nA + nB): so (A - B)^2 nA nB / (nA + nB)^2 is unbiased for it.
std::vector<Estimate> estimate_pixels(const Film& film, const HalfCounts& halves) {
    std::vector<Estimate> estimates(film.pixels() * 3);
    const double quantum = std::ldexp(1.0, -film.quanta_log2);
    parallel_for(film.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (film.samples[p] == 0) continue;
            const std::array<double, 4> mean = pixel_mean(film, p);
            const double count = film.samples[p], first = halves.first(film.samples[p]),
                         second = count - first;
            const double weight = first / count * (second / count);
            for (std::size_t c = 0; c < 3; ++c) {
                const double sum = double(film.half_sums[p * 3 + c]) * quantum;
                const double a = sum / first, b = (mean[c] * count - sum) / second;
                estimates[p * 3 + c] = {float(mean[c]), float(weight * (a - b) * (a - b)),
                                        float(std::min(a, b))};
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
/// the two are blended as in Lee's local-statistics filter (1980), by the share of their difference that is
/// content rather than noise. Of a pixel whose halves differ by far more than its neighbours' do, the darker
/// half is taken: a rare bright path is in the other one, and would hide itself in its own denominator.
double inverse_square(const Estimate& own, const Window& neighbours) {
    const auto inverse = [](double r) { return 1.0 / (r * r + 0.01); };
    const double n = neighbours.pixels;
    if (n < 2.0 || own.variance == 0.0f) return inverse(own.mean);
    const double mean = neighbours.mean / n, noise = neighbours.variance / n;
    const double spread = (neighbours.square - n * mean * mean) / (n - 1.0);
    double content = std::max(0.0, spread - noise);
    // 20 and .05 were found on 14 scenes at 16 and 64 samples, where a factor of two changes few medians by a
    // tenth.
    const double excess = own.variance / (20.0 * (noise + 0.05 * content));
    const double rare = std::isfinite(excess * excess) ? excess * excess / (1.0 + excess * excess) : 1.0;
    const double value = std::lerp(double(own.mean), double(own.darker), rare);
    const double value_noise = std::lerp(double(own.variance), 2.0 * noise, rare);
    // A bright pixel among dark ones is content that they do not show; a dark one may have missed its light.
    if (value > mean) content = std::max(content, (value - mean) * (value - mean) - value_noise);
    const double sum = content + value_noise;
    const double share = sum > 0.0 ? content / sum : 1.0;
    return std::lerp(inverse(mean), inverse(value), share);
}

/// Sums of the columns of a window, apart for its even and its odd rows.
using Columns = std::array<std::vector<Window>, 2>;

/// Errors of the pixels of row y, neighbours taken from 5 x 5 pixels (of one set: 7 x 7, as many). `columns`:
/// room for a Window per pixel and channel.
void errors_of_row(const Film& film, const std::vector<Estimate>& estimates, std::size_t y, Neighbours which,
                   Columns& columns, float* errors) {
    const std::size_t radius = which == Neighbours::all ? 2 : 3;
    const std::size_t width = film.width, row = width * 3;
    for (std::vector<Window>& sums : columns) std::fill(sums.begin(), sums.end(), Window{});
    for (std::size_t v = y - std::min(y, radius); v < std::min<std::size_t>(y + radius + 1, film.height); ++v)
        for (std::size_t i = 0; i < row; ++i) columns[v & 1][i].add(window_of(estimates[v * row + i]));
    for (std::size_t x = 0; x < width; ++x) {
        double sum = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const Estimate& own = estimates[y * row + x * 3 + c];
            Window neighbours;
            for (std::size_t u = x - std::min(x, radius); u < std::min(x + radius + 1, width); ++u)
                for (std::size_t odd = 0; odd < 2; ++odd)
                    if (which == Neighbours::all || odd == ((x ^ y ^ u) & 1))
                        neighbours.add(columns[odd][u * 3 + c]);
            neighbours.add(window_of(own), -1.0);
            sum += own.variance * inverse_square(own, neighbours);
        }
        errors[x] = float(sum / 3.0);
    }
}

}  // namespace

std::optional<HalfMeans> half_means(const Film& film) {
    const HalfCounts halves(film);
    if (!halves.known()) return std::nullopt;
    const std::size_t pixels = film.pixels();
    HalfMeans means{std::vector<float>(pixels * 3), std::vector<float>(pixels * 3),
                    std::vector<float>(pixels)};
    const double quantum = std::ldexp(1.0, -film.quanta_log2);
    for (std::size_t p = 0; p < pixels; ++p) {
        const double count = film.samples[p], first = halves.first(film.samples[p]), second = count - first;
        const std::array<double, 4> mean = pixel_mean(film, p);
        for (std::size_t c = 0; c < 3; ++c) {
            const double sum = double(film.half_sums[p * 3 + c]) * quantum;
            means.first[p * 3 + c] = float(sum / first);
            means.second[p * 3 + c] = float((mean[c] * count - sum) / second);
        }
        means.weight[p] = float(std::sqrt(first * second) / count);
    }
    return means;
}

std::vector<float> mean_variance(const Film& film) {
    const HalfCounts halves(film);
    if (!halves.known()) return {};
    const std::vector<Estimate> estimates = estimate_pixels(film, halves);
    std::vector<float> variance(estimates.size());
    for (std::size_t i = 0; i < variance.size(); ++i) variance[i] = estimates[i].variance;
    return variance;
}

std::vector<float> error_map(const Film& film, Neighbours which) {
    const HalfCounts halves(film);
    if (!halves.known() || film.pixels() == 0) return {};
    const std::vector<Estimate> estimates = estimate_pixels(film, halves);
    std::vector<float> errors(film.pixels());
    parallel_for(film.height, 8, [&](std::size_t begin, std::size_t end) {
        Columns columns{std::vector<Window>(std::size_t(film.width) * 3),
                        std::vector<Window>(std::size_t(film.width) * 3)};
        for (std::size_t y = begin; y < end; ++y)
            errors_of_row(film, estimates, y, which, columns, &errors[y * film.width]);
    });
    return errors;
}

double estimated_relmse(std::span<const float> error_map) {
    if (error_map.empty()) return -1.0;
    return std::accumulate(error_map.begin(), error_map.end(), 0.0) / double(error_map.size());
}

double estimated_relmse(const Film& film) { return estimated_relmse(error_map(film)); }

}  // namespace triad
