#include "panel/perceived.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/parallel_for.h"
#include "base/text.h"
#include "panel/fourier.h"
#include "panel/frame.h"
#include "panel/simulate.h"

namespace triad {
namespace {

using Complex = std::complex<double>;
using Planes = std::array<std::vector<double>, 3>;

constexpr unsigned rows_per_chunk = 16;
constexpr unsigned filter_border = 4, least_inside = 8;  // px
/// Degrees beyond which lies a thousandth of the square of S-CIELAB's widest narrow Gaussian, blue-yellow's,
/// seen from a straight border: 1.55 times .0536.
constexpr double eye_border = 0.083;

std::string size_text(const RgbImage& image) { return format("%u x %u", image.width, image.height); }

}  // namespace

struct PerceivedMetric::State {
    Panel panel;
    PerceivedChoice choice;
    unsigned width, height, samples;  ///< px
    unsigned margin_x, margin_y;      ///< px
    Fourier fourier;
    dvec3 white;
    dmat3 opponent;                                 ///< of panel RGB
    dmat3 back;                                     ///< to XYZ
    std::array<std::vector<float>, 3> sensitivity;  ///< of each frequency, over their number
    Planes wanted;
    RgbImage around;  ///< drives of the frame, and of the middle, which pictures replace; empty: none

    State(const Panel& p, const RgbImage& reference, unsigned s, const PerceivedChoice& c)
        : panel(p),
          choice(c),
          width(reference.width / s),
          height(reference.height / s),
          samples(s),
          margin_x(c.repeats ? 0 : frame_of(width, s, p.cell_x)),
          margin_y(c.repeats ? 0 : frame_of(height, s, p.cell_y)),
          fourier((width + 2 * margin_x) * s, (height + 2 * margin_y) * s) {
        const PanelLight light = panel_light(panel);
        white = light.white;
        const dmat3 from_xyz = opponent_of_xyz(choice.eye, white);
        opponent = from_xyz * dmat3(light.channel[0], light.channel[1], light.channel[2]);
        back = glm::inverse(from_xyz);
        weigh();
        const RgbImage whole = framed(reference, margin_x * samples, margin_y * samples);
        wanted = seen(whole);
        if (samples > 1 && !choice.repeats) around = boxed_drives(panel, whole, samples);
    }

    void weigh() {
        for (auto& plane : sensitivity) plane.resize(fourier.frequencies());
        const dvec2 step = choice.ppd * samples / dvec2(fourier.width(), fourier.height());
        parallel_for(fourier.height(), rows_per_chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) {
                const double fy = step.y * double(std::min<std::size_t>(y, fourier.height() - y));
                for (unsigned x = 0; x < fourier.columns(); ++x) {
                    const dvec3 h = contrast_sensitivity(choice.eye, std::hypot(step.x * x, fy));
                    for (int c = 0; c < 3; ++c)
                        sensitivity[std::size_t(c)][y * fourier.columns() + x] =
                            float(h[c] / double(fourier.size()));
                }
            }
        });
    }

    /// CIE XYZ as the eye sees it: each opponent channel keeps its share of each frequency.
    Planes seen(const RgbImage& image) const {
        Planes planes;
        for (auto& plane : planes) plane.resize(fourier.size());
        parallel_for(fourier.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const float* rgb = image.rgb.data() + 3 * i;
                const dvec3 o = opponent * dvec3(rgb[0], rgb[1], rgb[2]);
                for (int c = 0; c < 3; ++c) planes[std::size_t(c)][i] = o[c];
            }
        });
        parallel_for(3, 1, [&](std::size_t begin, std::size_t end) {
            std::vector<Complex> spectrum(fourier.frequencies());
            for (std::size_t c = begin; c < end; ++c) {
                fourier.forward(planes[c], spectrum);
                for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] *= sensitivity[c][i];
                fourier.backward(spectrum, planes[c]);
            }
        });
        parallel_for(fourier.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const dvec3 xyz = back * dvec3(planes[0][i], planes[1][i], planes[2][i]);
                for (int c = 0; c < 3; ++c) planes[std::size_t(c)][i] = xyz[c];
            }
        });
        return planes;
    }
};

unsigned perceived_border(double ppd) { return filter_border + unsigned(std::ceil(eye_border * ppd)); }
unsigned least_perceived_size(double ppd) { return 2 * perceived_border(ppd) + least_inside; }

PerceivedMetric::PerceivedMetric(const Panel& panel, const RgbImage& reference, unsigned samples,
                                 const PerceivedChoice& choice) {
    if (samples < 3 || reference.rgb.empty() || reference.width % samples || reference.height % samples)
        throw Error(
            Exit::comparison,
            format(
                "A perceived error needs a reference of 3 or more whole samples per pixel along both axes: "
                "%s is not a number of pixels at %u.",
                size_text(reference).c_str(), samples));
    const unsigned least = least_perceived_size(choice.ppd);
    if (!choice.border && std::min(reference.width, reference.height) < least * samples)
        throw Error(
            Exit::comparison,
            format(
                "The picture shows %u x %u pixels. At %g pixels per degree filter and eye see beyond its "
                "borders from %u pixels inside, so that at least %u x %u are needed for a perceived error.",
                reference.width / samples, reference.height / samples, choice.ppd,
                perceived_border(choice.ppd), least, least));
    state_ = std::make_unique<const State>(panel, reference, samples, choice);
}

PerceivedMetric::PerceivedMetric(PerceivedMetric&&) noexcept = default;
PerceivedMetric::~PerceivedMetric() = default;

PerceivedError PerceivedMetric::of(const RgbImage& drives) const {
    const State& s = *state_;
    if (drives.width != s.width || drives.height != s.height)
        throw Error(Exit::comparison, format("The picture is %s, its reference shows %u x %u pixels.",
                                             size_text(drives).c_str(), s.width, s.height));
    RgbImage whole = s.around;
    if (!s.choice.repeats) put_in_frame(drives, whole);
    const RgbImage light = simulate_panel(s.panel, s.choice.repeats ? drives : whole, s.samples, true);
    const Planes shown = s.seen(light);
    const dmat3 axes = linear_lab_of_xyz(s.white);
    const auto at = [](const Planes& p, std::size_t i) { return dvec3(p[0][i], p[1][i], p[2][i]); };

    PerceivedError result;
    const unsigned width = s.width * s.samples, height = s.height * s.samples;
    result.map = {width, height, std::vector<float>(std::size_t(width) * height * 3)};
    const unsigned border = s.samples * s.choice.border.value_or(perceived_border(s.choice.ppd));
    if (2 * border >= std::min(width, height))
        throw Error(Exit::comparison, format("A picture of %u x %u pixels has nothing within a border of %u.",
                                             s.width, s.height, border / s.samples));
    std::vector<double> distances;
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x) {
            const std::size_t i = (y + std::size_t(s.margin_y) * s.samples) * s.fourier.width() + x +
                                  std::size_t(s.margin_x) * s.samples;
            const dvec3 d = axes * (at(shown, i) - at(s.wanted, i));
            float* map = result.map.rgb.data() + (std::size_t(y) * width + x) * 3;
            for (int c = 0; c < 3; ++c) map[c] = float(d[c]);
            if (std::min(x, y) < border || x + border >= width || y + border >= height) continue;
            result.lightness += d.x * d.x;
            result.colour += d.y * d.y + d.z * d.z;
            distances.push_back(
                glm::distance(lab_of_xyz(at(shown, i), s.white), lab_of_xyz(at(s.wanted, i), s.white)));
            result.de_mean += distances.back();
        }
    const double count = double(distances.size());
    result.error = std::sqrt((result.lightness + result.colour) / count);
    result.lightness = std::sqrt(result.lightness / count);
    result.colour = std::sqrt(result.colour / count);
    result.de_mean /= count;
    const auto p95 = distances.begin() + std::ptrdiff_t(0.95 * (count - 1));
    std::nth_element(distances.begin(), p95, distances.end());
    result.de_p95 = *p95;
    return result;
}

double perceived_difference(const Panel& panel, const RgbImage& difference, const PerceivedChoice& choice) {
    const std::vector<float> map = perceived_difference_map(panel, difference, choice);
    return std::sqrt(std::accumulate(map.begin(), map.end(), 0.0) / double(map.size()));
}

std::vector<float> perceived_difference_map(const Panel& panel, const RgbImage& difference,
                                            const PerceivedChoice& choice) {
    const PerceivedMetric::State s(panel, difference, 1, choice);
    const dmat3 axes = linear_lab_of_xyz(s.white);
    std::vector<float> map(std::size_t(s.width) * s.height);
    for (unsigned y = 0; y < s.height; ++y)
        for (unsigned x = 0; x < s.width; ++x) {
            const std::size_t i = std::size_t(y + s.margin_y) * s.fourier.width() + x + s.margin_x;
            const dvec3 d = axes * dvec3(s.wanted[0][i], s.wanted[1][i], s.wanted[2][i]);
            map[std::size_t(y) * s.width + x] = float(glm::dot(d, d));
        }
    return map;
}

unsigned samples_per_pixel(const RgbImage& drives, const RgbImage& reference) {
    const unsigned samples = drives.width ? reference.width / drives.width : 0;
    if (samples < 1 || reference.width != samples * drives.width ||
        reference.height != samples * drives.height)
        throw Error(
            Exit::comparison,
            "The reference must have a whole number of samples per pixel, the same along both axes: the "
            "picture is " +
                size_text(drives) + ", the reference " + size_text(reference) + ".");
    return samples;
}

}  // namespace triad
