#include "metric/repetitions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>

#include "metric/statistics.h"

namespace triad {
namespace {

constexpr double level = 0.95;
constexpr std::size_t resamples = 4000;
constexpr double most_extrapolation = 4.0;

/// The value that a share q of the sorted values lies below.
double quantile(std::span<const double> sorted, double q) {
    return sorted[std::min(sorted.size() - 1, std::size_t(q * double(sorted.size())))];
}

/// Moves the values.
double median_of(std::vector<double>& v) {
    if (v.empty()) throw std::invalid_argument("no values have no median");
    const auto middle = v.begin() + std::ptrdiff_t(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    if (v.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(v.begin(), middle));
}

std::vector<double> logarithms(std::span<const double> values) {
    std::vector<double> logs(values.size());
    std::transform(values.begin(), values.end(), logs.begin(), [](double v) { return std::log(v); });
    return logs;
}

}  // namespace

double median(std::span<const double> values) {
    std::vector<double> copy(values.begin(), values.end());
    return median_of(copy);
}

Estimate median_estimate(std::span<const double> values) {
    std::mt19937_64 random(20220401);
    std::vector<double> medians(resamples), sample(values.size());
    for (double& m : medians) {
        // The same on every system, which std::uniform_int_distribution is not.
        for (double& s : sample) s = values[(random() >> 32) * values.size() >> 32];
        m = median_of(sample);
    }
    std::sort(medians.begin(), medians.end());
    return {median(values), quantile(medians, 0.5 * (1 - level)), quantile(medians, 0.5 * (1 + level))};
}

Estimate mean_estimate(std::span<const double> values) {
    if (values.empty()) throw std::invalid_argument("no values have no mean");
    const double n = double(values.size());
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / n;
    for (const double v : values) squares += (v - mean) * (v - mean);
    const double wide = values.size() < 2
                            ? std::numeric_limits<double>::infinity()
                            : student_t_critical(1 - level, n - 1) * std::sqrt(squares / (n * (n - 1)));
    return {mean, mean - wide, mean + wide};
}

Estimate geometric_mean_estimate(std::span<const double> values) {
    const Estimate e = mean_estimate(logarithms(values));
    return {std::exp(e.value), std::exp(e.low), std::exp(e.high)};
}

Estimate ratio_estimate(std::span<const double> log_a, std::span<const double> log_b) {
    const WelchTest test = welch_test(log_a, log_b);
    const double difference = test.mean_b - test.mean_a;
    const double wide = test.t == 0 ? 0 : difference / test.t * student_t_critical(1 - level, test.dof);
    return {std::exp(difference), std::exp(difference - wide), std::exp(difference + wide)};
}

std::optional<double> fit_power(std::span<const double> x, std::span<const double> y) {
    const std::vector<double> lx = logarithms(x), ly = logarithms(y);
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < lx.size(); ++i) {
        mean_x += lx[i] / double(lx.size());
        mean_y += ly[i] / double(lx.size());
    }
    for (std::size_t i = 0; i < lx.size(); ++i) {
        xx += (lx[i] - mean_x) * (lx[i] - mean_x);
        xy += (lx[i] - mean_x) * (ly[i] - mean_y);
    }
    if (!(xx > 0)) return {};
    return xy / xx;
}

std::optional<double> seconds_to_error(std::span<const TimedError> curve, double error) {
    std::vector<double> times, errors;
    for (const TimedError& point : curve) {
        if (!(point.error > 0 && point.seconds > 0)) return {};
        times.push_back(point.seconds), errors.push_back(point.error);
    }
    if (curve.empty()) return {};
    std::size_t after = curve.size();  // the first point from which on all are at or below `error`
    while (after > 0 && errors[after - 1] <= error) --after;
    if (after > 0 && after < curve.size()) {
        const double share =
            std::log(errors[after - 1] / error) / std::log(errors[after - 1] / errors[after]);
        return times[after - 1] * std::pow(times[after] / times[after - 1], share);
    }
    const std::size_t end = after == 0 ? 0 : curve.size() - 1;
    const auto power = fit_power(times, errors);
    if (!power || *power >= 0) return {};
    const double factor = std::pow(error / errors[end], 1 / *power);
    if (std::abs(std::log(factor)) > std::log(most_extrapolation)) return {};
    return times[end] * factor;
}

}  // namespace triad
