#pragma once
/// What the cases on single functions share: small kernels from source, and the chi-square test.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/math.h"
#include "device/device.h"

namespace triad {

/// Runs one kernel of `source` over `count` items; its arguments are (out, `arguments`..., count).
template <class T>
std::vector<T> run_kernel(Device& device, const std::string& source, const std::string& kernel,
                          const Arguments& arguments, std::size_t count, std::size_t results_per_item = 1,
                          const Options& options = {}) {
    const Buffer out = device.allocate(count * results_per_item * sizeof(T));
    device.run(device.build_source(kernel + ".cl", source, options).kernel(kernel),
               Arguments().add(out).add(arguments).add(std::uint32_t(count)), count);
    return device.download<T>(out);
}

/// Pearson's statistic of counts against expected counts as a standard normal (Wilson and Hilferty). Cells
/// that expect fewer than five are pooled; a draw where nothing can be is infinitely unlikely.
inline double chi_square_z(const std::vector<double>& counts, const std::vector<double>& expected) {
    double chi2 = 0, pooled_count = 0, pooled = 0;
    int cells = 0;
    const auto add = [&](double n, double e) { chi2 += (n - e) * (n - e) / e, ++cells; };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 5)
            add(counts[i], expected[i]);
        else
            pooled_count += counts[i], pooled += std::max(0.0, expected[i]);
    }
    if (pooled >= 5)
        add(pooled_count, pooled);
    else if (pooled_count > 5 + 10 * std::sqrt(pooled + 1))
        return INFINITY;
    const double k = std::max(1, cells - 1);
    return (std::cbrt(chi2 / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
}

/// One-sided significance 2.9e-7 per test: below 1e-4 for all chi-square tests together, with fixed seeds.
inline constexpr double chi_square_limit = 5;

/// Edge of a square grid of at most `most` x `most` cells that expects 16 or more of `count` in each.
inline int grid_edge(std::size_t count, int most) {
    return std::clamp(int(std::sqrt(double(count) / 16)), 2, most);
}

}  // namespace triad
