#include "panel/designer.h"

#include <algorithm>
#include <cmath>

namespace triad {
namespace {

using Values = Designer::Values;

constexpr double coupled = 0.85;       // covariance of two channels of a picture
constexpr double least_reach = 6;      // cycles per pixel
constexpr unsigned least_period = 16;  // px; taps change by less than .0003 beyond
constexpr unsigned most_steps = 2000;
constexpr double tolerance = 1e-9;  // of the residual, against the first

/// Power spectrum of pictures, per cycle per pixel.
double spectrum(const dvec2& f) { return 1 / (glm::dot(f, f) + 0.02 * 0.02); }

double sinc(double x) { return std::abs(x) < 1e-12 ? 1 : std::sin(pi * x) / (pi * x); }
double sinc(const dvec2& f) { return sinc(f.x) * sinc(f.y); }

double covariance(unsigned a, unsigned b) { return a == b ? 1 : coupled; }

/// First and number of the bins whose centre is at most `radius` px from `centre`.
std::pair<int, unsigned> bins_around(double centre, double radius, unsigned bins) {
    const int first = int(std::ceil((centre - radius) * bins - 0.5 - 1e-9));
    const int last = int(std::floor((centre + radius) * bins - 0.5 + 1e-9));
    return {first, unsigned(std::max(last - first + 1, 1))};
}

/// How much of [i, i + 1] / bins lies within half a pixel of `centre`.
double box_share(int i, double centre, unsigned bins) {
    const double lo = std::max(i / double(bins), centre - 0.5);
    return std::max(0.0, std::min((i + 1) / double(bins), centre + 0.5) - lo);
}

double dot(const Values& a, const Values& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Calls visit(index of the tap, index in the grid) for the taps of a filter.
void each(const Fourier& grid, const TapFilter& f, auto&& visit) {
    const int w = int(grid.width()), h = int(grid.height());
    std::size_t tap = f.begin;
    for (int y = f.first_y; y < f.first_y + int(f.height); ++y)
        for (int x = f.first_x; x < f.first_x + int(f.width); ++x)
            visit(tap++, std::size_t((y % h + h) % h) * std::size_t(w) + std::size_t((x % w + w) % w));
}

}  // namespace

Designer::Designer(const Panel& panel, double ppd, const TapDesign& design)
    : bins_(design.bins_x, design.bins_y),
      cell_(panel.cell_x * panel.cell_y),
      pull_share_(design.pull),
      period_(ErrorForm::period_of(panel, least_period)),
      reach_(std::max<double>(least_reach, std::max(bins_.x, bins_.y))),
      grid_(period_ * bins_.x, period_ * bins_.y),
      weight_(grid_.frequencies()),
      form_(panel, eye_responses(panel, ppd, design.eyes), period_, reach_,
            [this](const ErrorForm::Frequency& f, std::size_t outputs) { add(f, outputs); }) {
    for (std::size_t e = 0; e < form_.count(); ++e) {
        const Output& o = form_.outputs()[e];
        for (unsigned j = 0; j < 3; ++j)
            if (design.cross_colour || j == o.channel) add_filter(e, j, design.reach + spacing(o.channel));
    }
    add_pull();
}

Designer::Values Designer::solve() const {
    Values taps = start(), residual = right_side();
    const Values at_start = apply(taps);
    for (std::size_t i = 0; i < taps.size(); ++i) residual[i] -= at_start[i];
    project(residual);
    Values direction = residual;
    double square = dot(residual, residual);
    const double enough = square * tolerance * tolerance;
    for (unsigned step = 0; step < most_steps && square > enough; ++step) {
        Values image = apply(direction);
        project(image);
        const double length = square / dot(direction, image);
        for (std::size_t i = 0; i < taps.size(); ++i) {
            taps[i] += length * direction[i];
            residual[i] -= length * image[i];
        }
        const double next = dot(residual, residual);
        for (std::size_t i = 0; i < taps.size(); ++i)
            direction[i] = residual[i] + next / square * direction[i];
        square = next;
    }
    return taps;
}

double Designer::cost(const Values& taps) const {
    return dot(taps, apply(taps)) - 2 * dot(taps, right_side());
}

/// Index of a frequency among the bins' frequencies, or none where its conjugate stands for it.
std::optional<std::size_t> Designer::fold(int x, int y) const {
    const int w = int(grid_.width()), h = int(grid_.height());
    const unsigned qx = unsigned((x % w + w) % w), qy = unsigned((y % h + h) % h);
    if (qx >= grid_.columns()) return {};
    return std::size_t(qy) * grid_.columns() + qx;
}

/// Transform of one bin around its own centre, and the way from its corner to there.
Designer::Complex Designer::bin(const dvec2& f) const {
    const dvec2 part = f / dvec2(bins_);
    return sinc(part) * std::polar(1.0, pi * (part.x + part.y));
}

void Designer::add(const ErrorForm::Frequency& f, std::size_t outputs) {
    folded_.resize(outputs * 3, std::vector<Complex>(grid_.frequencies()));
    const auto q = fold(f.x, f.y);
    if (!q) return;
    const Complex phi = spectrum(f.f) * bin(f.f);
    weight_[*q] += spectrum(f.f) * std::norm(bin(f.f));
    for (std::size_t i = 0; i < folded_.size(); ++i) folded_[i][*q] += phi * f.r[i];
}

/// The share of the box in the right side. C is 1 on its diagonal, and the box sees its own colour alone.
void Designer::add_pull() {
    pull_.assign(form_.count(), std::vector<Complex>(grid_.frequencies()));
    const int most = int(std::ceil(reach_ * period_)) - 1;
    for (int y = -most; y <= most; ++y)
        for (int x = -most; x <= most; ++x) {
            const auto q = fold(x, y);
            if (!q) continue;
            const dvec2 f = dvec2(x, y) / double(period_);
            const Complex scale = pull_share_ * form_.trace() * spectrum(f) * bin(f) * sinc(f);
            for (std::size_t e = 0; e < form_.count(); ++e)
                pull_[e][*q] += scale * std::polar(1.0, -2 * pi * glm::dot(f, form_.outputs()[e].centre));
        }
}

/// Of the outputs of a channel that feed emitters, px.
double Designer::spacing(unsigned channel) const {
    const auto count = std::count_if(form_.outputs().begin(), form_.outputs().end(),
                                     [channel](const Output& o) { return o.channel == channel; });
    return std::sqrt(cell_ / double(count));
}

void Designer::add_filter(std::size_t e, unsigned channel, double radius) {
    const Output& o = form_.outputs()[e];
    const auto [x, width] = bins_around(o.centre.x, radius, bins_.x);
    const auto [y, height] = bins_around(o.centre.y, radius, bins_.y);
    filters_.push_back({e, channel, x, y, width, height, count_});
    count_ += std::size_t(width) * height;
}

Designer::Values Designer::start() const {
    Values taps(count_);
    for (const TapFilter& f : filters_) {
        const Output& o = output(f);
        if (f.channel != o.channel) continue;
        double sum = 0;
        std::size_t tap = f.begin;
        for (int y = 0; y < int(f.height); ++y)
            for (int x = 0; x < int(f.width); ++x, ++tap)
                sum += taps[tap] = box_share(f.first_x + x, o.centre.x, bins_.x) *
                                   box_share(f.first_y + y, o.centre.y, bins_.y);
        for (tap = f.begin; tap < f.begin + f.width * f.height; ++tap) taps[tap] /= sum;
    }
    return taps;
}

/// Takes out what would change the sum of a filter.
void Designer::project(Values& taps) const {
    for (const TapFilter& f : filters_) {
        const auto begin = taps.begin() + std::ptrdiff_t(f.begin), end = begin + f.width * f.height;
        double sum = 0;
        for (auto tap = begin; tap != end; ++tap) sum += *tap;
        for (auto tap = begin; tap != end; ++tap) *tap -= sum / (f.width * f.height);
    }
}

Designer::Values Designer::right_side() const {
    Values taps(count_), plane(grid_.size());
    std::vector<Complex> sum(grid_.frequencies());
    for (const TapFilter& f : filters_) {
        std::fill(sum.begin(), sum.end(), 0);
        for (std::size_t q = 0; q < sum.size(); ++q) {
            for (unsigned j = 0; j < 3; ++j)
                sum[q] += covariance(f.channel, j) * folded_[3 * f.output + j][q];
            sum[q] += covariance(f.channel, output(f).channel) * pull_[f.output][q];
        }
        grid_.backward(sum, plane);
        each(grid_, f, [&](std::size_t tap, std::size_t at) { taps[tap] = plane[at]; });
    }
    return taps;
}

Designer::Values Designer::apply(const Values& taps) const {
    std::vector<std::vector<Complex>> transforms(filters_.size(), std::vector<Complex>(grid_.frequencies()));
    Values plane(grid_.size()), result(count_);
    for (std::size_t p = 0; p < filters_.size(); ++p) {
        std::fill(plane.begin(), plane.end(), 0);
        each(grid_, filters_[p], [&](std::size_t tap, std::size_t at) { plane[at] = taps[tap]; });
        grid_.forward(plane, transforms[p]);
    }
    const double pulled = pull_share_ * form_.trace();
    std::vector<Complex> sum(grid_.frequencies());
    for (const TapFilter& f : filters_) {
        for (unsigned y = 0, q = 0; y < grid_.height(); ++y)
            for (unsigned x = 0; x < grid_.columns(); ++x, ++q) {
                const Complex* a = form_.a(int(x), int(y)) + f.output * form_.count();
                Complex total = 0;
                for (std::size_t p = 0; p < filters_.size(); ++p) {
                    const TapFilter& other = filters_[p];
                    const double own = other.output == f.output ? pulled : 0;
                    total += covariance(f.channel, other.channel) * (std::conj(a[other.output]) + own) *
                             transforms[p][q];
                }
                sum[q] = weight_[q] * total;
            }
        grid_.backward(sum, plane);
        each(grid_, f, [&](std::size_t tap, std::size_t at) { result[tap] = plane[at]; });
    }
    return result;
}

}  // namespace triad
