#include "metric/image_metrics.h"

#include <cmath>
#include <stdexcept>

namespace triad {
namespace {

template <class Term>
double mean_of(std::span<const float> picture, std::span<const float> reference, Term term) {
    if (picture.size() != reference.size() || picture.empty())
        throw std::invalid_argument("pictures to compare must have equally many values, at least one");
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) sum += term(double(picture[i]), double(reference[i]));
    return sum / double(picture.size());
}

double square(double v) { return v * v; }

double mean_square_error(std::span<const float> picture, std::span<const float> reference) {
    return mean_of(picture, reference, [](double x, double r) { return square(x - r); });
}

}  // namespace

double mean_absolute_error(std::span<const float> picture, std::span<const float> reference) {
    return mean_of(picture, reference, [](double x, double r) { return std::abs(x - r); });
}

double rmse(std::span<const float> picture, std::span<const float> reference) {
    return std::sqrt(mean_square_error(picture, reference));
}

double relmse(std::span<const float> picture, std::span<const float> reference) {
    return mean_of(picture, reference, [](double x, double r) { return square(x - r) / (square(r) + 0.01); });
}

double psnr(std::span<const float> picture, std::span<const float> reference, double peak) {
    return 10.0 * std::log10(peak * peak / mean_square_error(picture, reference));
}

}  // namespace triad
