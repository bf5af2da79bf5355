#include "metric/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "base/math.h"

namespace triad {
namespace {

/// log(Gamma(a + 1/2) / Gamma(a)); for large a by its asymptotic series, as the difference of logarithms
/// loses digits.
double log_gamma_ratio(double a) {
    if (a < 100.0) return std::lgamma(a + 0.5) - std::lgamma(a);
    return 0.5 * std::log(a) - 1.0 / (8.0 * a) + 1.0 / (192.0 * a * a * a);
}

/// Regularised incomplete beta function I_x(a, b) for x below (a + 1) / (a + b + 2), where the continued
/// fraction DLMF 8.17.22 converges fast; evaluated by the modified Lentz method (Thompson and Barnett 1986).
/// `log_front` is the logarithm of x^a (1 - x)^b / B(a, b), which the caller knows to more digits than x
/// gives.
double incomplete_beta(double x, double a, double b, double log_front) {
    constexpr double tiny = 1e-300, epsilon = 1e-15;
    double c = 1.0, d = 1.0 / std::max(1.0 - (a + b) * x / (a + 1.0), tiny), fraction = d;
    for (int m = 1; m < 100000; ++m) {
        double change = 1.0;
        const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        for (const double term : {even, odd}) {
            d = 1.0 + term * d;
            c = 1.0 + term / c;
            if (std::abs(d) < tiny) d = tiny;
            if (std::abs(c) < tiny) c = tiny;
            d = 1.0 / d;
            change = c * d;
            fraction *= change;
        }
        if (std::abs(change - 1.0) < epsilon) break;
    }
    return std::exp(log_front) * fraction / a;
}

double mean_of(std::span<const double> values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}

/// Variance of the mean of the values.
double mean_variance_of(std::span<const double> values, double mean) {
    double sum = 0;
    for (const double v : values) sum += (v - mean) * (v - mean);
    const double n = double(values.size());
    return sum / (n * (n - 1.0));
}

unsigned tiles_along(unsigned pixels, unsigned tile) { return (pixels + tile - 1) / tile; }

/// Means of every tile, [tile][channel], and of the whole picture in three more values.
std::vector<double> tile_means(const Batch& batch, unsigned tile) {
    const unsigned across = tiles_along(batch.width, tile), down = tiles_along(batch.height, tile);
    const std::size_t tiles = std::size_t(across) * down;
    std::vector<double> means((tiles + 1) * 3), pixels(tiles);
    for (unsigned y = 0; y < batch.height; ++y)
        for (unsigned x = 0; x < batch.width; ++x) {
            const std::size_t t = std::size_t(y / tile) * across + x / tile;
            pixels[t] += 1.0;
            for (int c = 0; c < 3; ++c) {
                const double value = batch.rgb[(std::size_t(y) * batch.width + x) * 3 + c];
                means[t * 3 + c] += value;
                means[tiles * 3 + c] += value;
            }
        }
    for (std::size_t i = 0; i < tiles * 3; ++i) means[i] /= pixels[i / 3];
    for (int c = 0; c < 3; ++c) means[tiles * 3 + c] /= double(batch.width) * batch.height;
    return means;
}

std::vector<std::vector<double>> all_tile_means(std::span<const Batch> batches, const Batch& like,
                                                unsigned tile) {
    if (batches.size() < 2) throw std::invalid_argument("pictures are compared by two or more batches each");
    std::vector<std::vector<double>> means;
    for (const Batch& b : batches) {
        if (b.width != like.width || b.height != like.height || b.rgb.empty() ||
            b.rgb.size() != std::size_t(b.width) * b.height * 3)
            throw std::invalid_argument("all batches of pictures to compare must have one size, not zero");
        means.push_back(tile_means(b, tile));
    }
    return means;
}

}  // namespace

double student_t_tail(double t, double dof) {
    if (std::isnan(t) || !(dof > 0)) throw std::invalid_argument("Student's t needs numbers, and dof > 0");
    t = std::abs(t);
    if (dof > 1e8)
        return std::erfc(t / std::sqrt(2.0));  // normal; the tail is off by t^4 / (4 dof) of itself
    if (t == 0.0) return 1.0;
    if (std::isinf(t)) return 0.0;
    const double ratio = t / std::sqrt(dof) * (t / std::sqrt(dof)), a = 0.5 * dof;
    const double x = 1.0 / (1.0 + ratio), y = ratio / (1.0 + ratio);  // y = 1 - x
    const double log_x = -std::log1p(ratio), log_y = std::log(ratio) + log_x;
    const double log_beta = 0.5 * std::log(pi) - log_gamma_ratio(a);
    const double log_front = a * log_x + 0.5 * log_y - log_beta;
    if (x < (a + 1.0) / (a + 2.5)) return incomplete_beta(x, a, 0.5, log_front);
    return 1.0 - incomplete_beta(y, 0.5, a, log_front);
}

double student_t_critical(double significance, double dof) {
    if (!(significance > 0.0 && significance <= 1.0))
        throw std::invalid_argument("a significance is above 0 and not above 1");
    double low = 0.0, high = 1.0;
    while (student_t_tail(high, dof) > significance) low = high, high *= 2.0;
    while (true) {  // until the bounds are neighbours
        const double middle = low + 0.5 * (high - low);
        if (middle == low || middle == high) return high;
        (student_t_tail(middle, dof) > significance ? low : high) = middle;
    }
}

double sidak(double family, std::size_t comparisons) {
    return -std::expm1(std::log1p(-family) / double(comparisons));
}

WelchTest welch_test(std::span<const double> a, std::span<const double> b, double rounding) {
    if (a.size() < 2 || b.size() < 2) throw std::invalid_argument("Welch's t needs two values of each");
    WelchTest test{.mean_a = mean_of(a), .mean_b = mean_of(b)};
    const double noise_a = mean_variance_of(a, test.mean_a), noise_b = mean_variance_of(b, test.mean_b);
    const double known = rounding * rounding * (test.mean_a * test.mean_a + test.mean_b * test.mean_b);
    const double difference = test.mean_b - test.mean_a, variance = noise_a + noise_b + known;
    // Rounding is known, not estimated: it adds to the variance and not to the doubt about it.
    const double doubt = noise_a * noise_a / double(a.size() - 1) + noise_b * noise_b / double(b.size() - 1);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (!std::isfinite(variance)) {
        test.t = infinite, test.dof = infinite, test.p = 0.0;
        return test;
    }
    test.dof = doubt > 0.0 ? variance * variance / doubt : infinite;
    test.t = difference == 0.0 ? 0.0 : difference / std::sqrt(variance);
    test.p = student_t_tail(test.t, test.dof);
    return test;
}

std::string Agreement::sentence() const {
    char text[400];
    std::snprintf(
        text, sizeof text,
        "%zu of %zu comparisons differ; the least probable: %s, means %.6g and %.6g (%+.3g %%), t = "
        "%.2f with %.1f degrees of freedom, allowed %.2f",
        rejected, comparisons, worst_place.c_str(), worst.mean_a, worst.mean_b,
        100.0 * (worst.mean_b / worst.mean_a - 1.0), worst.t, worst.dof, critical_t);
    return text;
}

Agreement compare_pictures(std::span<const Batch> a, std::span<const Batch> b, const AgreementPlan& plan) {
    if (a.empty() || plan.tile == 0) throw std::invalid_argument("nothing to compare, or tiles of no size");
    const auto means_a = all_tile_means(a, a.front(), plan.tile);
    const auto means_b = all_tile_means(b, a.front(), plan.tile);
    const std::size_t values = means_a.front().size(), tile_values = values - 3;
    const unsigned across = tiles_along(a.front().width, plan.tile);
    const double tile_limit = sidak(0.5 * plan.family, tile_values),
                 whole_limit = sidak(0.5 * plan.family, 3);

    Agreement result;
    result.comparisons = values;
    double worst_ratio = std::numeric_limits<double>::infinity();
    std::vector<double> sample_a(a.size()), sample_b(b.size());
    for (std::size_t i = 0; i < values; ++i) {
        for (std::size_t k = 0; k < a.size(); ++k) sample_a[k] = means_a[k][i];
        for (std::size_t k = 0; k < b.size(); ++k) sample_b[k] = means_b[k][i];
        const WelchTest test = welch_test(sample_a, sample_b, plan.rounding);
        const bool whole = i >= tile_values;
        const double limit = whole ? whole_limit : tile_limit;
        if (test.p < limit) ++result.rejected;
        if (test.p / limit >= worst_ratio) continue;
        worst_ratio = test.p / limit;
        result.worst = test;
        result.critical_t = student_t_critical(limit, test.dof);
        const std::size_t tile = i / 3;
        result.worst_place =
            (whole ? std::string("whole picture")
                   : "tile " + std::to_string(tile % across) + ", " + std::to_string(tile / across)) +
            ", channel " + "RGB"[i % 3];
    }
    result.agree = result.rejected == 0;
    return result;
}

}  // namespace triad
