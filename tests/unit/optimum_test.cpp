// How near drives are to the best that a panel can show: the bounded least squares of a whole picture, on
// panels that the designer was not tuned on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "panel/design.h"
#include "panel/error_form.h"
#include "panel/fourier.h"
#include "panel/perceived.h"
#include "subpixel_scenes.h"

using namespace triad;
using namespace subpixel_scenes;

namespace {

using Complex = std::complex<double>;
using Drives = std::vector<double>;  // [output][cell row][cell column]

constexpr unsigned size = 32, samples = 12;  // px of a picture that repeats, and per pixel

struct Spot {
    unsigned channel, x, y;  // and its pixel
    dvec2 centre, extent;
};

Panel panel_of(const char* name, unsigned cell_x, unsigned cell_y, const std::vector<Spot>& spots) {
    Panel panel{.name = name, .cell_x = cell_x, .cell_y = cell_y};
    const Panel rgb = builtin_panel("rgb").value();
    for (const Spot& s : spots) {
        Emitter e = rgb.emitters[s.channel];
        const auto alike = [&](const Spot& other) { return other.channel == s.channel; };
        e.luminance /= double(std::count_if(spots.begin(), spots.end(), alike));
        e.centre = s.centre, e.pixel_x = s.x, e.pixel_y = s.y;
        const dvec2 h = s.extent / 2.0;
        e.aperture = {{{-h.x, -h.y}, {h.x, -h.y}, {h.x, h.y}, {-h.x, h.y}}};
        panel.emitters.push_back(e);
    }
    check_panel(panel);
    return panel;
}

/// One emitter in each pixel, green in every second.
Panel bayer() {
    const dvec2 e(0.9);
    return panel_of("bayer", 2, 2,
                    {{0, 0, 0, {0.5, 0.5}, e},
                     {1, 1, 0, {1.5, 0.5}, e},
                     {1, 0, 1, {0.5, 1.5}, e},
                     {2, 1, 1, {1.5, 1.5}, e}});
}
/// Stripes, every second row moved by half a pixel.
Panel delta() {
    std::vector<Spot> spots;
    for (unsigned y = 0; y < 2; ++y)
        for (unsigned c = 0; c < 3; ++c)
            spots.push_back({c, 0, y, {(2 * c + 1) / 6.0 + 0.5 * y, y + 0.5}, {0.3, 0.9}});
    return panel_of("delta", 1, 2, spots);
}
/// Red above green, a tall blue beside them.
Panel s_stripe() {
    return panel_of("s-stripe", 1, 1,
                    {{0, 0, 0, {0.3, 0.25}, {0.45, 0.4}},
                     {1, 0, 0, {0.3, 0.75}, {0.45, 0.4}},
                     {2, 0, 0, {0.8, 0.5}, {0.3, 0.9}}});
}
/// Drives that feed two emitters: of green, in corners.
Panel two_greens() {
    const dvec2 e(0.4);
    return panel_of("two-greens", 1, 1,
                    {{0, 0, 0, {0.25, 0.25}, e},
                     {1, 0, 0, {0.75, 0.25}, e},
                     {1, 0, 0, {0.25, 0.75}, e},
                     {2, 0, 0, {0.75, 0.75}, e}});
}
/// Of every colour: red, green, blue above blue, green, red.
Panel zigzag() {
    std::vector<Spot> spots;
    for (unsigned y = 0; y < 2; ++y)
        for (unsigned c = 0; c < 3; ++c)
            spots.push_back({y ? 2 - c : c, 0, 0, {(2 * c + 1) / 6.0, 0.25 + 0.5 * y}, {0.3, 0.45}});
    return panel_of("zigzag", 1, 1, spots);
}

RgbImage cut_out(const RgbImage& image, unsigned x, unsigned y, unsigned side) {
    RgbImage part{side, side, {}};
    for (unsigned row = 0; row < side; ++row) {
        const auto from = image.rgb.begin() + std::ptrdiff_t(((y + row) * image.width + x) * 3);
        part.rgb.insert(part.rgb.end(), from, from + side * 3);
    }
    return part;
}

/// Least |eyes(light of d - picture)|^2 with every drive in [0, 1], by FISTA (Beck & Teboulle 2009) on the
/// whole picture, which repeats.
class Optimum {
  public:
    Optimum(const Panel& panel, double ppd, const EyeShares& eyes, const RgbImage& picture)
        : panel_(panel),
          lattice_(size / panel.cell_x, size / panel.cell_y),
          spectrum_(spectrum_of(picture)),
          form_(panel, eye_responses(panel, ppd, eyes), size, 3,
                [this](const ErrorForm::Frequency& f, std::size_t outputs) { add(f, outputs); }) {}

    RgbImage drives(unsigned steps) const {
        const std::size_t n = form_.count() * lattice_.size();
        Drives x(n, 0.5), y = x, g(n);
        double length = 0;
        Drives any(n);
        for (std::size_t i = 0; i < n; ++i) any[i] = std::sin(double(i * i));
        for (unsigned i = 0; i < 60; ++i) {  // power method
            gradient(any, 0, g);
            length = std::sqrt(std::inner_product(g.begin(), g.end(), g.begin(), 0.0));
            for (std::size_t k = 0; k < n; ++k) any[k] = g[k] / length;
        }
        double t = 1;
        for (unsigned step = 0; step < steps; ++step) {
            gradient(y, 1, g);
            const double next_t = (1 + std::sqrt(1 + 4 * t * t)) / 2;
            for (std::size_t i = 0; i < n; ++i) {
                const double next = std::clamp(y[i] - g[i] / (1.05 * length), 0.0, 1.0);
                y[i] = next + (t - 1) / next_t * (next - x[i]);
                x[i] = next;
            }
            t = next_t;
        }
        RgbImage image{size, size, std::vector<float>(size * size * 3)};
        for (std::size_t e = 0; e < form_.count(); ++e) {
            const Output& o = form_.outputs()[e];
            for (unsigned v = 0; v < lattice_.height(); ++v)
                for (unsigned u = 0; u < lattice_.width(); ++u)
                    image.rgb[((v * panel_.cell_y + o.y) * size + u * panel_.cell_x + o.x) * 3 + o.channel] =
                        float(x[(e * lattice_.height() + v) * lattice_.width() + u]);
        }
        return image;
    }

  private:
    const Panel& panel_;
    Fourier lattice_;
    std::array<std::vector<Complex>, 3> spectrum_;  // of the picture's samples
    std::vector<std::vector<Complex>> wanted_;      // by output, frequencies of the lattice
    ErrorForm form_;

    static std::array<std::vector<Complex>, 3> spectrum_of(const RgbImage& picture) {
        const Fourier fine(picture.width, picture.height);
        std::array<std::vector<Complex>, 3> result;
        std::vector<double> plane(fine.size());
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < plane.size(); ++i)
                plane[i] = picture.rgb[3 * i + c] / double(plane.size());
            result[c].resize(fine.frequencies());
            fine.forward(plane, result[c]);
        }
        return result;
    }

    void add(const ErrorForm::Frequency& f, std::size_t outputs) {
        wanted_.resize(outputs, std::vector<Complex>(lattice_.frequencies()));
        const int w = int(lattice_.width()), h = int(lattice_.height()), n = int(size * samples);
        const unsigned u = unsigned((f.x % w + w) % w), v = unsigned((f.y % h + h) % h);
        if (u >= lattice_.columns()) return;
        const unsigned x = unsigned((f.x + n) % n), y = unsigned((f.y + n) % n),
                       columns = unsigned(n / 2 + 1);
        const Complex centre = std::polar(1.0, -pi * (f.f.x + f.f.y) / samples);
        for (std::size_t j = 0; j < 3; ++j) {
            const Complex r =
                x < columns
                    ? spectrum_[j][y * columns + x]
                    : std::conj(spectrum_[j][(unsigned(n) - y) % unsigned(n) * columns + unsigned(n) - x]);
            for (std::size_t e = 0; e < outputs; ++e)
                wanted_[e][v * lattice_.columns() + u] +=
                    std::conj(f.r[3 * e + j]) * r * centre * double(lattice_.size());
        }
    }

    /// A d - wanted.
    void gradient(const Drives& d, double wanted, Drives& g) const {
        const std::size_t k = form_.count();
        std::vector<std::vector<Complex>> transforms(k, std::vector<Complex>(lattice_.frequencies()));
        for (std::size_t e = 0; e < k; ++e)
            lattice_.forward({d.data() + e * lattice_.size(), lattice_.size()}, transforms[e]);
        std::vector<Complex> sum(lattice_.frequencies());
        for (std::size_t e = 0; e < k; ++e) {
            for (unsigned v = 0, q = 0; v < lattice_.height(); ++v)
                for (unsigned u = 0; u < lattice_.columns(); ++u, ++q) {
                    const Complex* a = form_.a(int(u), int(v)) + e * k;
                    sum[q] = -wanted * wanted_[e][q];
                    for (std::size_t other = 0; other < k; ++other) sum[q] += a[other] * transforms[other][q];
                    sum[q] /= double(lattice_.size());
                }
            lattice_.backward(sum, {g.data() + e * lattice_.size(), lattice_.size()});
        }
    }
};

/// S-CIELAB's error, and that of all eyes by their shares.
struct Seen {
    double scielab = 0, all = 0;
};

class Judge {
  public:
    Judge(const Panel& panel, double ppd, const RgbImage& picture) {
        for (const Eye eye : {Eye::scielab, Eye::sharp, Eye::flip})
            eyes_.emplace_back(panel, picture, samples,
                               PerceivedChoice{.ppd = ppd, .eye = eye, .repeats = true});
    }
    Seen of(const RgbImage& drives) const {
        const EyeShares shares;
        const double share[] = {shares.scielab, shares.sharp, shares.flip};
        Seen seen;
        for (std::size_t i = 0; i < 3; ++i) {
            const double error = eyes_[i].of(drives).error;
            if (i == 0) seen.scielab = error;
            seen.all += share[i] * error * error;
        }
        seen.all = std::sqrt(seen.all);
        return seen;
    }

  private:
    std::vector<PerceivedMetric> eyes_;
};

}  // namespace

TEST(Optimum, is_better_than_any_change_of_it) {
    if (!present()) GTEST_SKIP() << "no " << folder();
    const Panel panel = s_stripe();
    const RgbImage picture = cut_out(load("text"), 96, 96, size * samples);
    const RgbImage best = Optimum(panel, 45, {1, 0, 0}, picture).drives(400);
    const PerceivedMetric metric(panel, picture, samples, {.ppd = 45, .border = 0, .repeats = true});
    const double least = metric.of(best).error;
    for (unsigned i = 0; i < 60; ++i) {
        RgbImage other = best;
        for (unsigned k = 0; k < 40; ++k) {
            float& v = other.rgb[(i * 7919 + k * 104729) % other.rgb.size()];
            v = std::clamp(v + (k % 2 ? 0.02f : -0.02f), 0.0f, 1.0f);
        }
        EXPECT_GT(metric.of(other).error, least * 0.999) << i;
    }
}

TEST(Optimum, of_panels_that_the_designer_was_not_tuned_on_is_near) {
    if (!present()) GTEST_SKIP() << "no " << folder();
    for (const Panel& panel : {bayer(), delta(), s_stripe(), two_greens(), zigzag()})
        for (const double ppd : {30.0, 45.0, 70.0}) {
            const TapTable taps = design_taps(panel, ppd), boxes = displaced_box_taps(panel);
            const RefineStencil stencil = design_refine(panel, ppd);
            for (const char* scene : {"text", "voronoi"}) {
                const RgbImage picture = cut_out(load(scene), 96, 96, size * samples);
                const RgbImage bins = block_means(picture, 4, 4);
                const Judge judge(panel, ppd, picture);
                const Seen box = judge.of(clamped(filtered(bins, boxes, Beyond::again))),
                           triad = judge.of(refined(filtered(bins, taps, Beyond::again), stencil, 5)),
                           best = judge.of(Optimum(panel, ppd, {}, picture).drives(400)),
                           alone = judge.of(Optimum(panel, ppd, {1, 0, 0}, picture).drives(400));
                std::printf("| %s | %g | %s | %.3g | %.3g | %.3g | %.2f | %.3g | %.3g | %.3g |\n",
                            panel.name.c_str(), ppd, scene, box.all, triad.all, best.all,
                            triad.all / best.all, box.scielab, triad.scielab, alone.scielab);
                EXPECT_LT(triad.all, 1.2 * best.all) << panel.name << ", " << ppd << ", " << scene;
                EXPECT_LT(triad.all, box.all) << panel.name << ", " << ppd << ", " << scene;
            }
        }
}
