#include "panel/error_form.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "panel/aperture.h"

namespace triad {
namespace {

/// Of what is seen at frequency 0: less than this changes no digit that is used.
constexpr double unseen = 1e-7;

/// Along the three axes of one eye after the other.
using Seen = std::vector<std::complex<double>>;

std::complex<double> inner(const Seen& a, const Seen& b) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::conj(a[i]) * b[i];
    return sum;
}

double greatest(const std::vector<dmat3>& eyes) {
    double most = 0;
    for (const dmat3& m : eyes)
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
    std::vector<Seen> v(k);
    Seen channel;
    std::vector<Complex> r(3 * k);
    for (int y = -most; y <= most; ++y)
        for (int x = -most; x <= most; ++x) {
            const dvec2 f = dvec2(x, y) / double(period);
            const std::vector<dmat3> eyes = eye(glm::length(f));
            if (greatest(eyes) < least) {
                std::fill(r.begin(), r.end(), 0);
                if (visit) visit({x, y, f, r.data()}, k);
                continue;
            }
            const auto add = [&](const dvec3& xyz, const Complex& shape, Seen& to) {
                for (std::size_t i = 0; i < eyes.size(); ++i) {
                    const dvec3 response = eyes[i] * xyz;
                    for (int c = 0; c < 3; ++c) to[3 * i + std::size_t(c)] += shape * response[c];
                }
            };
            for (std::size_t e = 0; e < k; ++e) {
                v[e].assign(3 * eyes.size(), 0);
                for (const unsigned i : outputs_[e].emitters)
                    add(light[i],
                        aperture_transform(panel.emitters[i].aperture, f) *
                            std::polar(1.0, -2 * pi * glm::dot(f, panel.emitters[i].centre)),
                        v[e]);
            }
            for (std::size_t j = 0; j < 3; ++j) {
                channel.assign(3 * eyes.size(), 0);
                add(channels.channel[j], 1, channel);
                for (std::size_t e = 0; e < k; ++e) r[3 * e + j] = inner(channel, v[e]);
            }
            Complex* a = a_.data() + std::size_t(wrap(y, zone_y_) * zone_x_ + wrap(x, zone_x_)) * k * k;
            for (std::size_t e = 0; e < k; ++e)
                for (std::size_t other = 0; other < k; ++other) a[e * k + other] += inner(v[e], v[other]);
            if (visit) visit({x, y, f, r.data()}, k);
        }
    for (std::size_t e = 0; e < k; ++e) trace_ += a_[e * k + e].real() / double(k);
}

ErrorForm::Response eye_responses(const Panel& panel, double ppd, const EyeShares& shares) {
    std::vector<std::pair<double, EyeResponse>> eyes;
    const dvec3 white = panel_light(panel).white;
    for (const auto& [eye, share] : {std::pair(Eye::scielab, shares.scielab),
                                     std::pair(Eye::sharp, shares.sharp), std::pair(Eye::flip, shares.flip)})
        if (share > 0) eyes.emplace_back(std::sqrt(share), EyeResponse(eye, white));
    return [eyes, ppd](double f) {
        std::vector<dmat3> seen;
        for (const auto& [weight, eye] : eyes) seen.push_back(weight * eye.at(f * ppd));
        return seen;
    };
}

}  // namespace triad
