#include "panel/error_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "panel/aperture.h"

namespace triad {
namespace {

/// Of what is seen at frequency 0: less than this changes no digit that is used.
constexpr double unseen = 1e-7;

using CVec3 = std::array<std::complex<double>, 3>;

std::complex<double> dot(const CVec3& a, const dvec3& b) { return a[0] * b.x + a[1] * b.y + a[2] * b.z; }

std::complex<double> inner(const CVec3& a, const CVec3& b) {
    return std::conj(a[0]) * b[0] + std::conj(a[1]) * b[1] + std::conj(a[2]) * b[2];
}

double greatest(const dmat3& m) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(m[c][r]));
    return most;
}

}  // namespace

unsigned ErrorForm::period_of(const Panel& panel, unsigned least) {
    const unsigned cell = std::lcm(panel.cell_x, panel.cell_y);
    return (least + cell - 1) / cell * cell;
}

ErrorForm::ErrorForm(const Panel& panel, const Response& eye, unsigned period, double reach,
                     const std::function<void(const Frequency&, std::size_t)>& visit) {
    for (Output& output : panel_outputs(panel))
        if (!output.emitters.empty()) outputs_.push_back(std::move(output));
    zone_x_ = int(period / panel.cell_x), zone_y_ = int(period / panel.cell_y);
    const std::size_t k = count();
    a_.resize(std::size_t(zone_x_) * std::size_t(zone_y_) * k * k);

    const std::vector<dvec3> light = emitter_light(panel);
    const PanelLight channels = panel_light(panel);
    const double least = unseen * greatest(eye(0));
    const int most = int(std::ceil(reach * period)) - 1;
    std::vector<CVec3> v(k);
    std::vector<Complex> r(3 * k);
    for (int y = -most; y <= most; ++y)
        for (int x = -most; x <= most; ++x) {
            const dvec2 f = dvec2(x, y) / double(period);
            const dmat3 seen = eye(glm::length(f));
            if (greatest(seen) < least) {
                std::fill(r.begin(), r.end(), 0);
                if (visit) visit({x, y, f, r.data()}, k);
                continue;
            }
            for (std::size_t e = 0; e < k; ++e) {
                v[e] = {};
                for (const unsigned i : outputs_[e].emitters) {
                    const Emitter& emitter = panel.emitters[i];
                    const Complex shape = aperture_transform(emitter.aperture, f) *
                                          std::polar(1.0, -2 * pi * glm::dot(f, emitter.centre));
                    const dvec3 response = seen * light[i];
                    for (int c = 0; c < 3; ++c) v[e][std::size_t(c)] += shape * response[c];
                }
                for (std::size_t j = 0; j < 3; ++j) r[3 * e + j] = dot(v[e], seen * channels.channel[j]);
            }
            Complex* a = a_.data() + std::size_t(wrap(y, zone_y_) * zone_x_ + wrap(x, zone_x_)) * k * k;
            for (std::size_t e = 0; e < k; ++e)
                for (std::size_t other = 0; other < k; ++other) a[e * k + other] += inner(v[e], v[other]);
            if (visit) visit({x, y, f, r.data()}, k);
        }
    for (std::size_t e = 0; e < k; ++e) trace_ += a_[e * k + e].real() / double(k);
}

}  // namespace triad
