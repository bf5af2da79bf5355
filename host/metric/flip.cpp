#include "metric/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/math.h"
#include "base/parallel_for.h"

namespace triad {
namespace {

constexpr std::size_t rows_per_chunk = 8;

using Plane = std::vector<float>;  // row by row
using Kernel = std::vector<float>;

struct Size {
    std::size_t width, height;
};

/// Convolution with kernels of odd lengths along x and y; beyond the borders the border's pixels go on.
Plane convolve(const Plane& in, Size size, const Kernel& along_x, const Kernel& along_y) {
    const auto rx = std::ptrdiff_t(along_x.size() / 2), ry = std::ptrdiff_t(along_y.size() / 2);
    const auto width = std::ptrdiff_t(size.width), height = std::ptrdiff_t(size.height);
    Plane rows(in.size()), out(in.size());
    parallel_for(size.height, rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        std::vector<float> padded(std::size_t(width + 2 * rx));
        for (std::size_t y = begin; y < end; ++y) {
            const float* from = in.data() + y * size.width;
            for (std::ptrdiff_t x = 0; x < width + 2 * rx; ++x)
                padded[std::size_t(x)] = from[std::clamp<std::ptrdiff_t>(x - rx, 0, width - 1)];
            float* to = rows.data() + y * size.width;
            for (std::size_t k = 0; k < along_x.size(); ++k)
                for (std::size_t x = 0; x < size.width; ++x) to[x] += along_x[k] * padded[x + k];
        }
    });
    parallel_for(size.height, rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            float* to = out.data() + y * size.width;
            for (std::size_t k = 0; k < along_y.size(); ++k) {
                const std::ptrdiff_t row = std::ptrdiff_t(y + k) - ry;
                const float* from =
                    rows.data() + std::size_t(std::clamp<std::ptrdiff_t>(row, 0, height - 1)) * size.width;
                for (std::size_t x = 0; x < size.width; ++x) to[x] += along_y[k] * from[x];
            }
        }
    });
    return out;
}

/// Positive and negative taps are scaled to sums of 1 and -1.
void normalise(Kernel& kernel) {
    float positive = 0, negative = 0;
    for (const float k : kernel) (k > 0 ? positive : negative) += std::abs(k);
    for (float& k : kernel) k /= k > 0 ? positive : std::max(negative, 1e-30f);
}

/// exp(-x^2 / (2 sigma^2)) times 1 and its derivatives: -x / sigma^2, x^2 / sigma^2 - 1, each normalised.
Kernel gaussian(double sigma, int radius, int derivative = 0) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-0.5 * x * x / (sigma * sigma));
        kernel.push_back(float(derivative == 0   ? g
                               : derivative == 1 ? -x * g
                                                 : (x * x / (sigma * sigma) - 1) * g));
    }
    normalise(kernel);
    return kernel;
}

// sRGB's primaries as exact fractions, and the white that they add up to.
constexpr double to_xyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382},
};

/// XYZ over that of white.
dvec3 relative_xyz(const dvec3& rgb) {
    dvec3 v;
    for (int i = 0; i < 3; ++i)
        v[i] = (to_xyz[i][0] * rgb.x + to_xyz[i][1] * rgb.y + to_xyz[i][2] * rgb.z) /
               (to_xyz[i][0] + to_xyz[i][1] + to_xyz[i][2]);
    return v;
}

dvec3 rgb_of(const dvec3& xyz) {
    static const dmat3 inverse = [] {
        dmat3 m;  // GLM's are column by column
        for (int c = 0; c < 3; ++c) {
            dvec3 unit(0.0);
            unit[c] = 1;
            m[c] = relative_xyz(unit);
        }
        return glm::inverse(m);
    }();
    return inverse * xyz;
}

/// L*a*b* with a and b weakened where it is dark (Hunt's effect).
dvec3 hunt_lab(const dvec3& rgb) {
    constexpr double d = 6.0 / 29;
    const dvec3 xyz = relative_xyz(rgb);
    dvec3 f;
    for (int i = 0; i < 3; ++i)
        f[i] = xyz[i] > d * d * d ? std::cbrt(xyz[i]) : xyz[i] / (3 * d * d) + 4.0 / 29;
    const double lightness = 116 * f.y - 16;
    return {lightness, 0.01 * lightness * 500 * (f.x - f.y), 0.01 * lightness * 200 * (f.y - f.z)};
}

/// HyAB, to the power that makes large differences of colour count less.
double colour_distance(const dvec3& a, const dvec3& b) {
    return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
}

/// What is compared of a picture.
struct Seen {
    std::vector<dvec3> colours;          ///< Hunt-adjusted, after the eye's contrast sensitivity
    std::array<Plane, 2> edges, points;  ///< derivatives of the luma along x and y
};

Seen see(const RgbImage& image, double ppd) {
    const Size size{image.width, image.height};
    const std::size_t pixels = size.width * size.height;
    std::array<Plane, 3> opponent;  // Y, Cx, Cz: linear, so that they can be filtered
    opponent.fill(Plane(pixels));
    Plane luma(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        dvec3 rgb;
        for (int c = 0; c < 3; ++c) {
            const float v = image.rgb[3 * p + std::size_t(c)];
            rgb[c] = v > 0 ? std::min(v, 1.0f) : 0.0f;
        }
        const dvec3 xyz = relative_xyz(rgb);
        luma[p] = float(xyz.y);
        opponent[0][p] = float(116 * xyz.y - 16);
        opponent[1][p] = float(500 * (xyz.x - xyz.y));
        opponent[2][p] = float(200 * (xyz.y - xyz.z));
    }

    // Contrast sensitivity: sums of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
    const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    const auto blur = [&](const Plane& plane, double b) {
        const Kernel g = gaussian(std::sqrt(b / (2 * pi * pi)) * ppd, radius);
        return convolve(plane, size, g, g);
    };
    const auto share = [&](double a, double b) {  // of the sum of the taps, before they are normalised
        double sum = 0;
        for (int x = -radius; x <= radius; ++x) sum += std::exp(-pi * pi * x * x / (b * ppd * ppd));
        return a * std::sqrt(pi / b) * sum * sum;
    };
    const Plane y = blur(opponent[0], 0.0047), cx = blur(opponent[1], 0.0053);
    const Plane wide = blur(opponent[2], 0.04), narrow = blur(opponent[2], 0.025);
    const double w = share(34.1, 0.04), n = share(13.5, 0.025);

    Seen seen;
    seen.colours.resize(pixels);
    parallel_for(pixels, rows_per_chunk * size.width, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const double cz = (w * wide[p] + n * narrow[p]) / (w + n), ny = (y[p] + 16.0) / 116;
            const dvec3 rgb = rgb_of({ny + cx[p] / 500.0, ny, ny - cz / 200});
            seen.colours[p] = hunt_lab(glm::clamp(rgb, 0.0, 1.0));
        }
    });

    const double sigma = 0.5 * 0.082 * ppd;  // of the features: edges of .082 degrees
    const int reach = int(std::ceil(3 * sigma));
    const Kernel g = gaussian(sigma, reach);
    const Kernel slope = gaussian(sigma, reach, 1), bend = gaussian(sigma, reach, 2);
    seen.edges = {convolve(luma, size, slope, g), convolve(luma, size, g, slope)};
    seen.points = {convolve(luma, size, bend, g), convolve(luma, size, g, bend)};
    return seen;
}

}  // namespace

std::vector<float> flip_map(const RgbImage& picture, const RgbImage& reference, double ppd) {
    if (picture.width != reference.width || picture.height != reference.height || picture.rgb.empty())
        throw std::invalid_argument("FLIP compares pictures of one size, not zero");
    const Seen a = see(picture, ppd), b = see(reference, ppd);
    const double most = colour_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
    const double knee = 0.4 * most;  // differences up to here are mapped to [0, .95]
    const auto length = [](const std::array<Plane, 2>& v, std::size_t p) {
        return std::hypot(v[0][p], v[1][p]);
    };
    std::vector<float> map(a.colours.size());
    parallel_for(map.size(), rows_per_chunk * picture.width, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const double distance = colour_distance(a.colours[p], b.colours[p]);
            const double colour =
                distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (most - knee);
            const double feature = std::max(std::abs(length(a.edges, p) - length(b.edges, p)),
                                            std::abs(length(a.points, p) - length(b.points, p)));
            map[p] = float(std::pow(colour, 1 - std::sqrt(feature / std::sqrt(2.0))));
        }
    });
    return map;
}

double mean_flip(const std::vector<float>& map) {
    double sum = 0;
    for (const float v : map) sum += v;
    return sum / double(map.size());
}

}  // namespace triad
