#pragma once
/// Numbers from repeated measurements, with 95 % intervals.
#include <optional>
#include <span>
#include <vector>

namespace triad {

/// A number with its 95 % interval.
struct Estimate {
    double value = 0, low = 0, high = 0;
};

/// The middle value, or the mean of the two in the middle. Throws std::invalid_argument for no values.
double median(std::span<const double> values);

/// Median, with the interval of the percentile bootstrap (Efron 1979; 4000 resamples, fixed seed). From five
/// values it is the least and the greatest: 94 %. One value has no interval: it is all three numbers.
Estimate median_estimate(std::span<const double> values);

/// Mean, with Student's interval: right from two values on where they are roughly normal, while a bootstrap
/// of five covers the mean only 5 times in 6. Of a single value the interval is infinite.
Estimate mean_estimate(std::span<const double> values);

/// exp of mean_estimate() of the logarithms: for ratios.
Estimate geometric_mean_estimate(std::span<const double> values);

/// exp(mean of log_b - mean of log_a), of values given by their logarithms, with the interval of Welch's t;
/// two or more of each.
Estimate ratio_estimate(std::span<const double> log_a, std::span<const double> log_b);

/// The exponent b of y = a x^b through positive points, by least squares on logarithms; none for fewer than
/// two different x.
std::optional<double> fit_power(std::span<const double> x, std::span<const double> y);

/// When a run had which error.
struct TimedError {
    double seconds, error;
};

/// The time from which on a curve stays below `error`: interpolated between logarithms where the curve passes
/// it last. Beyond the ends the power law that fits all points goes on, for a factor of four in time; none
/// beyond, or where errors are not positive. `curve` by rising seconds.
std::optional<double> seconds_to_error(std::span<const TimedError> curve, double error);

}  // namespace triad
