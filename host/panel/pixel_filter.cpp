#include "panel/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/error.h"

namespace triad {
namespace {

constexpr double widest = 16.0;

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); }

/// Mitchell and Netravali 1988, "Reconstruction filters in computer graphics", eq. 8; support [-2, 2].
double cubic(double b, double c, double x) {
    x = std::abs(x);
    if (x < 1.0) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) /
           6;
}

/// The integral over [a, b], which lies within the support, by Gauss and Legendre's rule of four points on
/// pieces so short that no shape bends within one.
double integral(const PixelFilter& filter, double a, double b) {
    constexpr double node[2] = {0.339981043584856, 0.861136311594053},
                     weight[2] = {0.652145154862546, 0.347854845137454};
    constexpr int pieces = 64;
    const double half = 0.5 * (b - a) / pieces;
    double sum = 0.0;
    for (int piece = 0; piece < pieces; ++piece) {
        const double middle = a + (2 * piece + 1) * half;
        for (int i = 0; i < 2; ++i)
            sum += weight[i] * (filter_value(filter, middle - node[i] * half) +
                                filter_value(filter, middle + node[i] * half));
    }
    return sum * half;
}

struct Row {
    int first = 0;
    std::vector<double> weights;  ///< sum 1
};

Row weights_of_bins(const PixelFilter& filter, unsigned bins, double centre) {
    const double radius = 0.5 * filter.width, edge = 1e-9;
    Row row;
    row.first = int(std::floor((centre - radius) * bins + edge));
    const int end = int(std::ceil((centre + radius) * bins - edge));
    for (int i = row.first; i < end; ++i)
        row.weights.push_back(integral(filter, std::max(double(i) / bins - centre, -radius),
                                       std::min(double(i + 1) / bins - centre, radius)));
    const double sum = std::accumulate(row.weights.begin(), row.weights.end(), 0.0);
    for (double& w : row.weights) w /= sum;
    return row;
}

/// To floats whose sum is 1: the largest takes what rounding leaves.
std::vector<float> rounded(const std::vector<double>& weights) {
    std::vector<float> result(weights.begin(), weights.end());
    const double sum = std::accumulate(result.begin(), result.end(), 0.0);
    float& largest = *std::max_element(result.begin(), result.end());
    largest = float(largest + (1.0 - sum));
    return result;
}

}  // namespace

const std::vector<std::string>& filter_names() {
    static const std::vector<std::string> names = {"box",         "tent",    "gaussian",       "mitchell",
                                                   "catmull-rom", "lanczos", "blackman-harris"};
    return names;
}

double default_width(FilterShape shape) {
    switch (shape) {
        case FilterShape::box:
            return 1.0;
        case FilterShape::tent:
            return 2.0;
        case FilterShape::gaussian:
        case FilterShape::blackman_harris:
            return 3.0;
        case FilterShape::mitchell:
        case FilterShape::catmull_rom:
            return 4.0;
        case FilterShape::lanczos:
            return 6.0;
    }
    throw std::logic_error("no such filter");
}

PixelFilter parse_filter(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string name = text.substr(0, colon);
    const auto found = std::find(filter_names().begin(), filter_names().end(), name);
    if (found == filter_names().end()) {
        std::string names;
        for (const std::string& known : filter_names()) names += (names.empty() ? "" : ", ") + known;
        throw Error(Exit::usage, "--filter " + text + ": there is no such filter. There are " + names +
                                     ", each with :WIDTH in pixels if wanted.");
    }
    PixelFilter filter;
    filter.shape = FilterShape(found - filter_names().begin());
    filter.width = default_width(filter.shape);
    if (colon != std::string::npos) {
        const std::string width = text.substr(colon + 1);
        std::size_t used = 0;
        try {
            filter.width = std::stod(width, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used == 0 || used != width.size() || !(filter.width > 0.0 && filter.width <= widest))
            throw Error(Exit::usage, "--filter " + text +
                                         ": the width is a number of pixels above 0, at most " +
                                         std::to_string(int(widest)) + ".");
    }
    return filter;
}

double filter_value(const PixelFilter& filter, double x) {
    const double radius = 0.5 * filter.width;
    if (!(std::abs(x) < radius)) return 0.0;
    const double u = x / radius;  // in (-1, 1)
    switch (filter.shape) {
        case FilterShape::box:
            return 1.0;
        case FilterShape::tent:
            return 1.0 - std::abs(u);
        case FilterShape::gaussian:  // sigma a third of the radius, lowered to end at 0
            return std::exp(-4.5 * u * u) - std::exp(-4.5);
        case FilterShape::mitchell:
            return cubic(1.0 / 3.0, 1.0 / 3.0, 2.0 * u);
        case FilterShape::catmull_rom:
            return cubic(0.0, 0.5, 2.0 * u);
        case FilterShape::lanczos:
            return sinc(3.0 * u) * sinc(u);
        case FilterShape::blackman_harris:  // Harris 1978, four terms, -92 dB
            return 0.35875 + 0.48829 * std::cos(pi * u) + 0.14128 * std::cos(2 * pi * u) +
                   0.01168 * std::cos(3 * pi * u);
    }
    throw std::logic_error("no such filter");
}

TapTable filter_taps(const PixelFilter& filter, unsigned bins_x, unsigned bins_y,
                     const std::array<dvec2, 3>& centres) {
    TapTable table;
    table.bins_x = bins_x, table.bins_y = bins_y;
    for (const dvec2& centre : centres) {
        const Row across = weights_of_bins(filter, bins_x, centre.x),
                  down = weights_of_bins(filter, bins_y, centre.y);
        Taps taps;
        taps.first_x = across.first, taps.first_y = down.first;
        taps.width = unsigned(across.weights.size()), taps.height = unsigned(down.weights.size());
        taps.across = rounded(across.weights), taps.down = rounded(down.weights);
        std::vector<double> product;
        for (const double v : down.weights)
            for (const double h : across.weights) product.push_back(v * h);
        taps.weights = rounded(product);
        table.outputs.push_back(std::move(taps));
    }
    return table;
}

}  // namespace triad
