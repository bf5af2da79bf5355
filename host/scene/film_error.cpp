/// The error of a film, from its two halves.
#include <algorithm>
#include <cmath>
#include <limits>
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

constexpr double largest = std::numeric_limits<float>::max();

/// Of every channel of every pixel: its mean, an unbiased estimate of that mean's variance, and the mean of
/// its darker half.
struct Estimates {
    std::vector<float> mean, variance, darker;
};

/// Halves of nA and nB samples with means A and B have Var(A - B) = s^2 (1/nA + 1/nB), and the mean of all
/// has s^2 / (nA + nB): so (A - B)^2 nA nB / (nA + nB)^2 is unbiased for it.
Estimates estimate_pixels(const Film& film, const HalfCounts& halves) {
    const std::size_t values = film.pixels() * 3;
    Estimates estimates{std::vector<float>(values), std::vector<float>(values), std::vector<float>(values)};
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
                estimates.mean[p * 3 + c] = float(mean[c]);
                estimates.variance[p * 3 + c] = float(std::min(weight * (a - b) * (a - b), largest));
                estimates.darker[p * 3 + c] = float(std::min(a, b));
            }
        }
    });
    return estimates;
}

/// One of them.
struct Estimate {
    float mean, variance, darker;
};

/// Sums over pixels: how many, their means, the squares of these, their variances.
struct Window {
    double pixels, mean, square, variance;
};

/// 1 / (r^2 + .01), r the unknown true value. The pixel's own noisy mean will not do alone: it is correlated
/// with the variance estimate (where a bright path was found both are too high), which makes the error look
/// several times too small at few samples. Its neighbours' mean has independent noise, but other content. So
/// the two are blended as in Lee's local-statistics filter (1980), by the share of their difference that is
/// content rather than noise. Of a pixel whose halves differ by far more than its neighbours' do, the darker
/// half is taken: a rare bright path is in the other one, and would hide itself in its own denominator.
double inverse_square(const Estimate& own, const Window& neighbours) {
    const auto square = [](double r) { return r * r; };
    const double n = neighbours.pixels;
    if (n < 2.0 || own.variance == 0.0f) return 1.0 / (square(own.mean) + 0.01);
    const double mean = neighbours.mean / n, noise = neighbours.variance / n;
    const double spread = (neighbours.square - n * mean * mean) / (n - 1.0);
    double content = std::max(0.0, spread - noise);
    // 20 and .05 were found on 14 scenes at 16 and 64 samples, where a factor of two changes few medians by a
    // tenth.
    const double usual = 20.0 * (noise + 0.05 * content), variance = own.variance;
    const double rare = square(variance) / (square(variance) + square(usual));
    const double value = own.mean + rare * (double(own.darker) - own.mean);
    const double value_noise = variance + rare * (2.0 * noise - variance);
    // A bright pixel among dark ones is content that they do not show; a dark one may have missed its light.
    content = std::max(content, square(std::max(0.0, value - mean)) - value_noise);
    const double sum = content + value_noise;
    // The two inverses blended, as one fraction: a, b and sum are far from a double's ends.
    const double a = square(mean) + 0.01, b = square(value) + 0.01;
    return sum > 0.0 ? (value_noise * b + content * a) / (a * b * sum) : 1.0 / b;
}

/// Such sums for every channel of a row, but for how many, with room for the widest window beyond both ends.
class RowOfSums {
  public:
    static constexpr std::size_t room = 3 * 3;  ///< pixels times channels

    explicit RowOfSums(std::size_t channels) : mean(channels + 2 * room), square(mean), variance(mean) {}

    void clear() {
        for (std::vector<double>* values : {&mean, &square, &variance})
            std::fill(values->begin(), values->end(), 0.0);
    }
    void add(const float* means, const float* variances) {
        for (std::size_t i = 0; i + 2 * room < mean.size(); ++i) {
            const double m = means[i];
            mean[room + i] += m, square[room + i] += m * m, variance[room + i] += variances[i];
        }
    }
    /// Those of the channels so many further on.
    void add(const RowOfSums& sums, std::ptrdiff_t offset) {
        const auto shift = [&](std::vector<double>& to, const std::vector<double>& from) {
            const double* const other = from.data() + offset;
            for (std::size_t i = room; i + room < to.size(); ++i) to[i] += other[i];
        };
        shift(mean, sums.mean), shift(square, sums.square), shift(variance, sums.variance);
    }

    std::vector<double> mean, square, variance;
};

/// Errors of rows of pixels, neighbours taken from 5 x 5 pixels (of one set: 7 x 7, as many).
class RowErrors {
  public:
    RowErrors(const Film& film, const Estimates& estimates, Neighbours which)
        : film_(film),
          estimates_(estimates),
          all_(which == Neighbours::all),
          radius_(all_ ? 2 : 3),
          columns_{RowOfSums(film.width * 3ul), RowOfSums(film.width * 3ul)},
          windows_(film.width * 3ul) {}

    void of(std::size_t y, float* errors) {
        const std::size_t row = film_.width * 3ul, first = y - std::min(y, radius_),
                          last = std::min<std::size_t>(y + radius_, film_.height - 1);
        const std::size_t odd_rows = (last + 1) / 2 - first / 2,
                          rows[] = {last - first + 1 - odd_rows, odd_rows};
        for (RowOfSums& sums : columns_) sums.clear();
        for (std::size_t v = first; v <= last; ++v)
            columns_[v & 1].add(&estimates_.mean[v * row], &estimates_.variance[v * row]);
        windows_.clear();
        for (std::ptrdiff_t d = -std::ptrdiff_t(radius_); d <= std::ptrdiff_t(radius_); ++d)
            for (const std::size_t odd : {0, 1})
                if (is_of_window(y, d, odd)) windows_.add(columns_[odd], 3 * d);
        for (std::size_t x = 0; x < film_.width; ++x) {
            std::size_t pixels = 0;
            for (std::ptrdiff_t d = -std::ptrdiff_t(std::min(x, radius_));
                 d <= std::ptrdiff_t(std::min(radius_, film_.width - 1 - x)); ++d)
                for (const std::size_t odd : {0, 1}) pixels += is_of_window(y, d, odd) ? rows[odd] : 0;
            double sum = 0.0;
            for (std::size_t i = x * 3; i < x * 3 + 3; ++i)
                sum += error(y * row + i, i + RowOfSums::room, pixels);
            errors[x] = float(std::min(sum / 3.0, largest));
        }
    }

  private:
    /// Whether the even, or the odd, rows of the column d beside a pixel of row y are its neighbours.
    bool is_of_window(std::size_t y, std::ptrdiff_t d, std::size_t odd) const {
        return all_ || odd == ((y ^ std::size_t(d)) & 1);
    }

    double error(std::size_t at, std::size_t in_row, std::size_t pixels) const {
        const Estimate own{estimates_.mean[at], estimates_.variance[at], estimates_.darker[at]};
        const double mean = own.mean, variance = own.variance;
        return variance * inverse_square(own, {double(pixels) - 1.0, windows_.mean[in_row] - mean,
                                               windows_.square[in_row] - mean * mean,
                                               windows_.variance[in_row] - variance});
    }

    const Film& film_;
    const Estimates& estimates_;
    bool all_;
    std::size_t radius_;
    std::array<RowOfSums, 2> columns_;  ///< of a window, apart for its even and its odd rows
    RowOfSums windows_;
};

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
    return estimate_pixels(film, halves).variance;
}

std::vector<float> error_map(const Film& film, Neighbours which) {
    const HalfCounts halves(film);
    if (!halves.known() || film.pixels() == 0) return {};
    const Estimates estimates = estimate_pixels(film, halves);
    std::vector<float> errors(film.pixels());
    parallel_for(film.height, 8, [&](std::size_t begin, std::size_t end) {
        RowErrors rows(film, estimates, which);
        for (std::size_t y = begin; y < end; ++y) rows.of(y, &errors[y * film.width]);
    });
    return errors;
}

double estimated_relmse(std::span<const float> error_map) {
    if (error_map.empty()) return -1.0;
    return std::accumulate(error_map.begin(), error_map.end(), 0.0) / double(error_map.size());
}

double estimated_relmse(const Film& film) { return estimated_relmse(error_map(film)); }

}  // namespace triad
