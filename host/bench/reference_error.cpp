#include "bench/reference_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "display/resolve.h"

namespace triad {
namespace {

constexpr double epsilon = 0.01;  // of relMSE
constexpr double trimmed_share = 0.001;
constexpr double firefly_ratio = 20;

double weight(double r) { return 1 / (r * r + epsilon); }

void require_size(std::span<const float> rgb, const Reference& reference) {
    if (rgb.size() != reference.mean.rgb.size() || rgb.empty())
        throw std::invalid_argument("a picture must have the size of its reference");
}

}  // namespace

RgbImage picture_of(const Film& film) {
    const std::vector<float> rgba = resolve_linear(film);
    RgbImage image{film.width, film.height, std::vector<float>(film.pixels() * 3)};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = rgba[i / 3 * 4 + i % 3];
    return image;
}

Reference make_reference(const Film& film) {
    const std::uint64_t n = film.sample_count();
    if (!film.is_even() || n == 0 || n % (2 * film.bins()) != 0)
        throw std::invalid_argument("a reference needs two equal halves");
    Reference reference{picture_of(film), std::vector<float>(film.pixels() * 3), {}, double(n), 0};
    reference.b = reference.a;
    const double scale = std::ldexp(1.0, -film.quanta_log2) / (double(n) / 2);
    for (std::size_t i = 0; i < reference.a.size(); ++i) {
        std::int64_t sum = 0;
        for (std::size_t bin = 0; bin < film.bins(); ++bin)
            sum += film.sums[(i / 3 * film.bins() + bin) * 4 + i % 3];
        reference.a[i] = float(double(film.half_sums[i]) * scale);
        reference.b[i] = float(double(sum - film.half_sums[i]) * scale);
        const double half = 0.5 * (double(reference.a[i]) - double(reference.b[i]));
        reference.relmse += half * half * weight(reference.mean.rgb[i]) / double(reference.a.size());
    }
    return reference;
}

PictureError picture_error(std::span<const float> rgb, const Reference& reference) {
    require_size(rgb, reference);
    const std::size_t pixels = rgb.size() / 3;
    PictureError e;
    std::vector<double> by_pixel(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        double brightness = 0, expected = 0;
        for (std::size_t i = 3 * p; i < 3 * p + 3; ++i) {
            const double x = rgb[i], r = reference.mean.rgb[i];
            const double square = (x - double(reference.a[i])) * (x - double(reference.b[i]));
            e.mse += square / double(rgb.size());
            by_pixel[p] += square * weight(r) / 3;
            brightness += x / 3, expected += r / 3;
        }
        e.relmse += by_pixel[p] / double(pixels);
        e.fireflies += brightness > firefly_ratio * (expected + epsilon);
    }
    const std::size_t kept = pixels - std::size_t(trimmed_share * double(pixels));
    std::nth_element(by_pixel.begin(), by_pixel.begin() + std::ptrdiff_t(kept - 1), by_pixel.end());
    for (std::size_t p = 0; p < kept; ++p) e.relmse_trimmed += by_pixel[p] / double(kept);
    return e;
}

std::vector<float> relative_difference(std::span<const float> rgb, const Reference& reference) {
    require_size(rgb, reference);
    std::vector<float> difference(rgb.size() / 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const double r = reference.mean.rgb[i];
        difference[i / 3] += float((rgb[i] - r) * std::sqrt(weight(r)) / 3);
    }
    return difference;
}

}  // namespace triad
