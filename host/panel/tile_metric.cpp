#include "panel/tile_metric.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.h"
#include "base/parallel_for.h"
#include "base/text.h"
#include "panel/frame.h"
#include "panel/simulate.h"

namespace triad {
namespace {

using Complex = std::complex<double>;

constexpr double unseen = 0.03;  // of a contrast: frequencies where every eye sees less are left out

/// Samples per pixel that hold what eyes see.
unsigned samples_for(double ppd, unsigned most) {
    for (unsigned samples = 2; samples < most; ++samples) {
        const auto sees = [&](Eye eye) {
            const dvec3 c = contrast_sensitivity(eye, ppd * samples / 2);
            return std::max({c.x, c.y, c.z}) > unseen;
        };
        if (std::none_of(all_eyes.begin(), all_eyes.end(), sees)) return samples;
    }
    return most;
}

int signed_frequency(unsigned i, unsigned n) { return 2 * i < n ? int(i) : int(i) - int(n); }
unsigned wrapped(int i, unsigned n) { return unsigned((i % int(n) + int(n)) % int(n)); }

/// Of the transform of a real array, which keeps half of its frequencies.
Complex at(const std::vector<Complex>& transform, const Fourier& f, unsigned x, unsigned y) {
    if (x < f.columns()) return transform[std::size_t(y) * f.columns() + x];
    return std::conj(transform[std::size_t((f.height() - y) % f.height()) * f.columns() + f.width() - x]);
}

const Panel& fitting(const Panel& panel, double ppd, const RgbImage& reference, unsigned samples) {
    const unsigned least = least_perceived_size(ppd);
    if (std::min(reference.width, reference.height) < least * samples)
        throw Error(Exit::usage,
                    format("The picture has %u x %u pixels; at %g pixels per degree %u x %u are needed; "
                           "choose another --size.",
                           reference.width / samples, reference.height / samples, ppd, least, least));
    if (reference.width % (samples * panel.cell_x) || reference.height % (samples * panel.cell_y))
        throw Error(Exit::usage, "The picture's size is not a whole number of cells of panel " + panel.name +
                                     "; choose another --size.");
    return panel;
}

}  // namespace

TileMetric::TileMetric(const Panel& panel, double ppd, const RgbImage& reference, unsigned samples)
    : panel_(fitting(panel, ppd, reference, samples)),
      ppd_(ppd),
      width_(reference.width / samples),
      height_(reference.height / samples),
      samples_(samples),
      map_samples_(samples_for(ppd, samples)),
      frame_x_(frame_of(width_, samples, panel.cell_x)),
      frame_y_(frame_of(height_, samples, panel.cell_y)),
      has_white_(std::any_of(panel.emitters.begin(), panel.emitters.end(),
                             [](const Emitter& e) { return e.feed == Feed::white; })),
      lattice_((width_ + 2 * frame_x_) / panel.cell_x, (height_ + 2 * frame_y_) / panel.cell_y),
      map_((width_ + 2 * frame_x_) * map_samples_, (height_ + 2 * frame_y_) * map_samples_) {
    const RgbImage whole = framed(reference, frame_x_ * samples, frame_y_ * samples);
    around_ = boxed_drives(panel, whole, samples);
    const auto all = transform(whole);
    for (std::size_t e = 0; e < all_eyes.size(); ++e) wanted_[e] = seen(all, all_eyes[e]);

    // One cell in the middle, lit by one drive alone, then moved to the origin.
    const unsigned cell_x = lattice_.width() / 2, cell_y = lattice_.height() / 2;
    for (unsigned channel = 0; channel < (has_white_ ? 4u : 3u); ++channel)
        for (unsigned y = 0; y < panel.cell_y; ++y)
            for (unsigned x = 0; x < panel.cell_x; ++x) {
                RgbImage lit{width_ + 2 * frame_x_, height_ + 2 * frame_y_, {}};
                lit.rgb.resize(std::size_t(lit.width) * lit.height * 3);
                float* rgb = &lit.rgb[(std::size_t(cell_y * panel.cell_y + y) * lit.width +
                                       cell_x * panel.cell_x + x) *
                                      3];
                for (unsigned c = 0; c < 3; ++c) rgb[c] = channel == c || channel == 3;
                const RgbImage light = simulate_panel(panel, lit, samples);
                if (std::none_of(light.rgb.begin(), light.rgb.end(), [](float v) { return v != 0; }))
                    continue;
                drives_.push_back({x, y, channel});
                auto moved = transform(light);
                for (unsigned v = 0; v < map_.height(); ++v)
                    for (unsigned u = 0; u < map_.columns(); ++u) {
                        const double turns =
                            double(u) * cell_x / lattice_.width() +
                            double(signed_frequency(v, map_.height())) * cell_y / lattice_.height();
                        const Complex back = std::polar(1.0, 2 * pi * (turns - std::floor(turns)));
                        for (auto& plane : moved) plane[std::size_t(v) * map_.columns() + u] *= back;
                    }
                for (std::size_t e = 0; e < all_eyes.size(); ++e)
                    light_[e].push_back(seen(moved, all_eyes[e]));
            }
}

/// The frequencies of the map, as if the picture's samples lay where the map's do.
std::array<std::vector<Complex>, 3> TileMetric::transform(const RgbImage& picture) const {
    const Fourier fine(picture.width, picture.height);
    std::array<std::vector<Complex>, 3> result;
    std::vector<double> plane(fine.size());
    std::vector<Complex> whole(fine.frequencies());
    const double shift = 0.5 / map_samples_ - 0.5 / samples_;  // px
    const dvec2 turns_of(shift * map_samples_ / map_.width(), shift * map_samples_ / map_.height());
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = picture.rgb[3 * i + c];
        fine.forward(plane, whole);
        result[c].resize(map_.frequencies());
        for (unsigned v = 0; v < map_.height(); ++v)
            for (unsigned u = 0; u < map_.columns(); ++u) {
                const int fv = signed_frequency(v, map_.height());
                if (2 * u == map_.width() || -2 * fv == int(map_.height())) continue;
                result[c][std::size_t(v) * map_.columns() + u] =
                    whole[std::size_t(wrapped(fv, fine.height())) * fine.columns() + u] *
                    std::polar(1.0 / double(fine.size()), 2 * pi * (u * turns_of.x + fv * turns_of.y));
            }
    }
    return result;
}

TileMetric::Spectrum TileMetric::seen(const std::array<std::vector<Complex>, 3>& rgb, Eye eye) const {
    const PanelLight light = panel_light(panel_);
    const EyeResponse response(eye, light.white);
    const dmat3 xyz(light.channel[0], light.channel[1], light.channel[2]);
    Spectrum spectrum(map_.frequencies());
    const dvec2 step = ppd_ * map_samples_ / dvec2(map_.width(), map_.height());
    parallel_for(map_.height(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            for (unsigned u = 0; u < map_.columns(); ++u) {
                const std::size_t i = v * map_.columns() + u;
                const dmat3 m = response.at(std::hypot(
                                    step.x * u, step.y * signed_frequency(unsigned(v), map_.height()))) *
                                xyz;
                for (int axis = 0; axis < 3; ++axis)
                    spectrum[i][std::size_t(axis)] =
                        m[0][axis] * rgb[0][i] + m[1][axis] * rgb[1][i] + m[2][axis] * rgb[2][i];
            }
    });
    return spectrum;
}

std::vector<double> TileMetric::levels(const RgbImage& picture, const Drive& drive) const {
    std::vector<double> result(lattice_.size());
    for (unsigned y = 0; y < lattice_.height(); ++y)
        for (unsigned x = 0; x < lattice_.width(); ++x) {
            const float* rgb =
                picture.rgb.data() +
                3 * (std::size_t(y * panel_.cell_y + drive.y) * picture.width + x * panel_.cell_x + drive.x);
            const auto level = [rgb](unsigned c) { return rgb[c] > 0 ? std::min(double(rgb[c]), 1.0) : 0.0; };
            const double white = has_white_ ? std::min({level(0), level(1), level(2)}) : 0.0;
            result[std::size_t(y) * lattice_.width() + x] =
                drive.channel == 3 ? white : level(drive.channel) - white;
        }
    return result;
}

std::array<TileErrors, all_eyes.size()> TileMetric::of(const RgbImage& drives) const {
    if (drives.width != width_ || drives.height != height_)
        throw std::invalid_argument("the picture is of another size than its reference");
    RgbImage picture = around_;
    put_in_frame(drives, picture);
    std::vector<std::vector<Complex>> shown;
    for (const Drive& drive : drives_) {
        shown.emplace_back(lattice_.frequencies());
        lattice_.forward(levels(picture, drive), shown.back());
    }
    std::array<TileErrors, all_eyes.size()> result;
    parallel_for(all_eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            std::array<std::vector<Complex>, 3> axes;
            for (auto& axis : axes) axis.resize(map_.frequencies());
            for (unsigned v = 0; v < map_.height(); ++v) {
                const unsigned y = wrapped(signed_frequency(v, map_.height()), lattice_.height());
                for (unsigned u = 0; u < map_.columns(); ++u) {
                    const std::size_t i = std::size_t(v) * map_.columns() + u;
                    Axes sum = {-wanted_[e][i][0], -wanted_[e][i][1], -wanted_[e][i][2]};
                    for (std::size_t d = 0; d < drives_.size(); ++d) {
                        const Complex level = at(shown[d], lattice_, u % lattice_.width(), y);
                        for (std::size_t a = 0; a < 3; ++a) sum[a] += level * light_[e][d][i][a];
                    }
                    for (std::size_t a = 0; a < 3; ++a) axes[a][i] = sum[a];
                }
            }
            PerceivedError error;
            error.map = {width_ * map_samples_, height_ * map_samples_, {}};
            error.map.rgb.resize(std::size_t(error.map.width) * error.map.height * 3);
            std::vector<double> values(map_.size());
            for (std::size_t a = 0; a < 3; ++a) {
                map_.backward(axes[a], values);
                for (unsigned y = 0; y < error.map.height; ++y)
                    for (unsigned x = 0; x < error.map.width; ++x)
                        error.map.rgb[(std::size_t(y) * error.map.width + x) * 3 + a] =
                            float(values[std::size_t(y + frame_y_ * map_samples_) * map_.width() + x +
                                         frame_x_ * map_samples_]);
            }
            result[e] = tile_errors(error, map_samples_, perceived_border(ppd_));
        }
    });
    return result;
}

}  // namespace triad
