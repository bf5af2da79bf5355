#include <algorithm>
#include <cmath>

#include "panel/design.h"
#include "panel/error_form.h"
#include "panel/eye.h"

namespace triad {
namespace {

using Complex = std::complex<double>;

constexpr double pull = 1e-3;    // lambda, as in the taps
constexpr unsigned period = 32;  // px
constexpr double reach = 6;      // cycles per pixel
constexpr int radius = 3;        // px

/// S-CIELAB's sharpest Gaussian of each opponent channel alone: a stencil of the whole eye would reach over
/// degrees.
ErrorForm::Response short_eye(const Panel& panel, double ppd) {
    const dvec3 white = panel_light(panel).white;
    const dmat3 to = opponent_of_xyz(Eye::scielab, white);
    const dmat3 from = linear_lab_of_xyz(white) * glm::inverse(to);
    return [=](double f) {
        const dvec3 spread{.0283, .0392, .0536};
        const dvec3 exponent = spread * (pi * f * ppd);
        const dvec3 h = glm::exp(-exponent * exponent);
        return from * dmat3(dvec3(h.x, 0, 0), dvec3(0, h.y, 0), dvec3(0, 0, h.z)) * to;
    };
}

using Matrix = std::vector<Complex>;  // Hermitian, row by row

/// By the power method, from below.
double greatest_eigenvalue(const Matrix& a, std::size_t n) {
    std::vector<Complex> v(n), image(n);
    for (std::size_t i = 0; i < n; ++i)
        v[i] = std::polar(1.0, double(i * i));  // orthogonal to nothing likely
    double norm = 0;
    for (int step = 0; step < 100; ++step) {
        double square = 0;
        for (std::size_t i = 0; i < n; ++i) {
            image[i] = 0;
            for (std::size_t j = 0; j < n; ++j) image[i] += a[i * n + j] * v[j];
            square += std::norm(image[i]);
        }
        norm = std::sqrt(square);
        if (norm == 0) return 0;
        for (std::size_t i = 0; i < n; ++i) v[i] = image[i] / norm;
    }
    return norm;
}

/// Bohman's: a form cut by it stays without negative values, because the window's transform has none. A form
/// that is merely cut has some (-2 % of the greatest at 45 pixels per degree, -15 % at 110), along which
/// steps run away.
double window(int distance) {
    const double t = std::abs(distance) / (radius + 1.0);
    return (1 - t) * std::cos(pi * t) + std::sin(pi * t) / pi;
}

int floor_div(int a, int b) { return (a >= 0 ? a : a - b + 1) / b; }

/// A between outputs of cells, by the distance of the cells, from its transform.
class Kernel {
  public:
    explicit Kernel(const ErrorForm& form) : form_(form) {}

    /// Between output e of a cell and output `other` of the cell x to its right and y below.
    double at(std::size_t e, std::size_t other, int x, int y) const {
        const int nx = form_.zone_x(), ny = form_.zone_y();
        Complex sum = 0;
        for (int v = 0; v < ny; ++v)
            for (int u = 0; u < nx; ++u)
                sum += form_.a(u, v)[e * form_.count() + other] *
                       std::polar(1.0, -2 * pi * (double(u) * x / nx + double(v) * y / ny));
        return sum.real() / (nx * ny);
    }

  private:
    const ErrorForm& form_;
};

}  // namespace

RefineStencil design_refine(const Panel& panel, double ppd) {
    check_design(ppd, 1, 1);
    RefineStencil stencil{panel.cell_x, panel.cell_y, unsigned(radius), {}, 1};
    constexpr std::size_t side = 2 * radius + 1;
    stencil.weights.assign(std::size_t(panel.cell_x) * panel.cell_y * 3 * side * side * 3, 0);
    if (panel.advice.full_pixel) return stencil;
    const ErrorForm form(panel, short_eye(panel, ppd), ErrorForm::period_of(panel, period), reach);
    const std::size_t k = form.count();
    const int cx = int(panel.cell_x), cy = int(panel.cell_y);
    const Kernel kernel(form);
    const double pulled = pull * form.trace();

    // The symbol of the cut stencil, at as many frequencies as A was known.
    std::vector<Matrix> symbols(std::size_t(form.zone_x() * form.zone_y()), Matrix(k * k));
    for (std::size_t e = 0; e < k; ++e)
        for (std::size_t other = 0; other < k; ++other) {
            const Output &to = form.outputs()[e], &from = form.outputs()[other];
            for (int dy = -radius; dy <= radius; ++dy)
                for (int dx = -radius; dx <= radius; ++dx) {
                    const int x = int(to.x) + dx, y = int(to.y) + dy;
                    const int right = floor_div(x, cx), below = floor_div(y, cy);
                    if (x - right * cx != int(from.x) || y - below * cy != int(from.y)) continue;
                    const double here = e == other && dx == 0 && dy == 0 ? pulled : 0;
                    const double a = window(dx) * window(dy) * kernel.at(e, other, right, below) + here;
                    const std::size_t output = (to.y * panel.cell_x + to.x) * 3 + to.channel;
                    stencil.weights[((output * side + std::size_t(dy + radius)) * side +
                                     std::size_t(dx + radius)) *
                                        3 +
                                    from.channel] = float(a);
                    for (int v = 0, q = 0; v < form.zone_y(); ++v)
                        for (int u = 0; u < form.zone_x(); ++u, ++q)
                            symbols[std::size_t(q)][e * k + other] += std::polar(
                                a,
                                2 * pi *
                                    (double(u) * right / form.zone_x() + double(v) * below / form.zone_y()));
                }
        }
    double greatest = 0;
    for (const Matrix& symbol : symbols) greatest = std::max(greatest, greatest_eigenvalue(symbol, k));
    stencil.step = float(1 / greatest);
    return stencil;
}

}  // namespace triad
