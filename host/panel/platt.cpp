#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "base/error.h"
#include "panel/design.h"
#include "panel/eye.h"

namespace triad {
namespace {

using Complex = std::complex<double>;
using Block = std::array<std::array<Complex, 3>, 3>;

constexpr int pixels = 64;     // of the period
constexpr int n = 3 * pixels;  // subpixels
constexpr int reach = 7;       // subpixels on each side that a filter keeps

/// Of the trace: where the eye sees no single subpixel, any drive would do. Each kind of filter gets what is
/// best for it at 45 pixels per degree; with less, the nine amplify what nobody sees until it is cut at black
/// and white.
constexpr double ridge_of_nine = 1e-3, ridge_of_three = 1e-6;

/// f[output][input][offset + n / 2]: what an input at subpixel i adds to the output at i + offset.
using Filters = std::array<std::array<std::array<double, n>, 3>, 3>;

/// Channels in their order along x or y, or an error.
struct Stripes {
    bool along_y = false;
    std::array<unsigned, 3> order{};
};

Stripes stripes_of(const Panel& panel) {
    const auto outputs = panel_outputs(panel);
    for (const bool along_y : {false, true}) {
        Stripes stripes{along_y, {}};
        bool even = panel.cell_x == 1 && panel.cell_y == 1 && !panel.advice.full_pixel;
        std::array<bool, 3> seen{};
        for (const Output& o : outputs) {
            const double along = along_y ? o.centre.y : o.centre.x,
                         across = along_y ? o.centre.x : o.centre.y;
            const int place = int(std::lround(along * 3 - 0.5));
            even = even && place >= 0 && place < 3 && std::abs(along * 3 - 0.5 - place) < 0.1 &&
                   std::abs(across - 0.5) < 0.1 && !seen[std::size_t(place)];
            if (even) seen[std::size_t(place)] = true, stripes.order[std::size_t(place)] = o.channel;
        }
        if (even) return stripes;
    }
    throw Error(Exit::usage, "The filters of platt are made for three even stripes; the panel " + panel.name +
                                 " has none. Use triad.");
}

/// Solves a x = b for a Hermitian, positive a by elimination.
std::array<Complex, 3> solve(Block a, std::array<Complex, 3> b) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t r = i + 1; r < 3; ++r) {
            const Complex factor = a[r][i] / a[i][i];
            for (std::size_t c = i; c < 3; ++c) a[r][c] -= factor * a[i][c];
            b[r] -= factor * b[i];
        }
    for (std::size_t i = 3; i-- > 0;) {
        for (std::size_t c = i + 1; c < 3; ++c) b[i] -= a[i][c] * b[c];
        b[i] /= a[i][i];
    }
    return b;
}

Complex wave(int k, int at) { return std::polar(1.0, -2 * pi * k * at / n); }

/// Every frequency of the pixels is three of the subpixels, in which all three drives of a pixel take part: a
/// block of 3 x 3 equations.
Filters filters_of(const Panel& panel, const Stripes& stripes, double ppd, double solvable) {
    const PanelLight light = panel_light(panel);
    const EyeResponse eye(Eye::scielab, light.white);
    Filters filters{};
    for (int kappa = 0; kappa < pixels; ++kappa) {
        Block a{};
        std::array<std::array<std::array<Complex, 3>, 3>, 3> b{};  // [input channel][its subpixel][drive]
        for (int k = kappa; k < n; k += pixels) {
            const int signed_k = k <= n / 2 ? k : k - n;
            const dmat3 t = eye.at(std::abs(signed_k) * 3.0 / n * ppd) *
                            dmat3(light.channel[0], light.channel[1], light.channel[2]);
            for (std::size_t p = 0; p < 3; ++p) {
                const dvec3 own = 3.0 * t[int(stripes.order[p])];
                for (std::size_t q = 0; q < 3; ++q) {
                    a[p][q] += glm::dot(own, 3.0 * t[int(stripes.order[q])]) * wave(k, int(q) - int(p));
                    for (std::size_t j = 0; j < 3; ++j)
                        b[j][q][p] += glm::dot(own, t[int(j)]) * wave(k, int(q) - int(p));
                }
            }
        }
        const double ridge = solvable * (a[0][0] + a[1][1] + a[2][2]).real() / 3;
        for (std::size_t p = 0; p < 3; ++p) a[p][p] += ridge;
        for (std::size_t j = 0; j < 3; ++j)
            for (int q = 0; q < 3; ++q) {
                const auto drives = solve(a, b[j][std::size_t(q)]);
                for (int p = 0; p < 3; ++p)
                    for (int m = 0; m < pixels; ++m) {
                        const int offset = (3 * m + p - q + n + n / 2) % n;
                        filters[stripes.order[std::size_t(p)]][j][std::size_t(offset)] +=
                            (drives[std::size_t(p)] * std::conj(wave(kappa, 3 * m))).real() / pixels;
                    }
            }
    }
    return filters;
}

/// The taps in the order of the bins, with this sum: what lacks goes to the box of one pixel.
std::vector<float> cut(const std::array<double, n>& filter, double wanted) {
    std::vector<double> taps;
    for (int bin = -reach; bin <= reach; ++bin) taps.push_back(filter[std::size_t(n / 2 - bin)]);
    double sum = 0;
    for (const double tap : taps) sum += tap;
    for (std::size_t i = reach - 1; i <= reach + 1; ++i) taps[i] += (wanted - sum) / 3;
    return {taps.begin(), taps.end()};
}

}  // namespace

TapTable platt_taps(const Panel& panel, double ppd, bool nine) {
    check_design(ppd, 3, 1);
    const Stripes stripes = stripes_of(panel);
    const Filters filters = filters_of(panel, stripes, ppd, nine ? ridge_of_nine : ridge_of_three);
    constexpr unsigned width = 2 * reach + 1;
    TapTable table{stripes.along_y ? 1u : 3u, stripes.along_y ? 3u : 1u, 1, 1, {}};
    for (unsigned c = 0; c < 3; ++c) {
        const int place =
            int(std::find(stripes.order.begin(), stripes.order.end(), c) - stripes.order.begin());
        Taps taps{place - reach, 0, width, 1, cut(filters[c][c], 1), {}, {}, {}};
        if (nine)
            for (unsigned j = 0; j < 3; ++j) {
                const auto cross = j == c ? std::vector<float>(width) : cut(filters[c][j], 0);
                taps.cross.insert(taps.cross.end(), cross.begin(), cross.end());
            }
        if (stripes.along_y) std::swap(taps.first_x, taps.first_y), std::swap(taps.width, taps.height);
        table.outputs.push_back(std::move(taps));
    }
    return table;
}

}  // namespace triad
