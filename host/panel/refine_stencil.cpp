#include <algorithm>
#include <cmath>

#include "panel/design.h"
#include "panel/error_form.h"

namespace triad {
namespace {

using Complex = std::complex<double>;
using Matrix = std::vector<Complex>;  // Hermitian, row by row

constexpr double penalty =
    0.01;  // rho, of the mean diagonal of A: what splits the eye's passband from the rest
constexpr unsigned period = 32;  // px
constexpr double eye_reach = 6;  // cycles per pixel
constexpr int radius = 4;        // px

/// A (A + rho I)^-1 = I - rho (A + rho I)^-1, by Gauss and Jordan; A + rho I has no small pivot.
Matrix low_pass(const Complex* a, std::size_t n, double rho) {
    Matrix m(a, a + n * n);
    for (std::size_t i = 0; i < n; ++i) m[i * n + i] += rho;
    for (std::size_t p = 0; p < n; ++p) {
        const Complex pivot = 1.0 / m[p * n + p];
        m[p * n + p] = 1;
        for (std::size_t j = 0; j < n; ++j) m[p * n + j] *= pivot;
        for (std::size_t i = 0; i < n; ++i) {
            if (i == p) continue;
            const Complex factor = m[i * n + p];
            m[i * n + p] = 0;
            for (std::size_t j = 0; j < n; ++j) m[i * n + j] -= factor * m[p * n + j];
        }
    }
    for (Complex& v : m) v *= -rho;
    for (std::size_t i = 0; i < n; ++i) m[i * n + i] += 1;
    return m;
}

/// Bohman's: its transform has no negative values, so that what it cuts keeps eigenvalues from 0 to 1 and
/// steps cannot run away. (Merely cut, they range from -.1 to 1.3.)
double window(int distance) {
    const double t = std::abs(distance) / (radius + 1.0);
    return (1 - t) * std::cos(pi * t) + std::sin(pi * t) / pi;
}

int floor_div(int a, int b) { return (a >= 0 ? a : a - b + 1) / b; }

/// The low pass between outputs of cells, by the distance of the cells, from its transform.
class Kernel {
  public:
    explicit Kernel(const ErrorForm& form) : form_(form) {
        for (int v = 0; v < form.zone_y(); ++v)
            for (int u = 0; u < form.zone_x(); ++u)
                transform_.push_back(low_pass(form.a(u, v), form.count(), penalty * form.trace()));
    }

    /// Between output e of a cell and output `other` of the cell x to its right and y below.
    double at(std::size_t e, std::size_t other, int x, int y) const {
        const int nx = form_.zone_x(), ny = form_.zone_y();
        Complex sum = 0;
        for (int v = 0, q = 0; v < ny; ++v)
            for (int u = 0; u < nx; ++u, ++q)
                sum += transform_[std::size_t(q)][e * form_.count() + other] *
                       std::polar(1.0, -2 * pi * (double(u) * x / nx + double(v) * y / ny));
        return sum.real() / (nx * ny);
    }

  private:
    const ErrorForm& form_;
    std::vector<Matrix> transform_;
};

}  // namespace

RefineStencil design_refine(const Panel& panel, double ppd, const EyeShares& eyes) {
    check_design(ppd, 1, 1);
    RefineStencil stencil{panel.cell_x, panel.cell_y, unsigned(radius), {}};
    constexpr std::size_t side = 2 * radius + 1;
    stencil.weights.assign(std::size_t(panel.cell_x) * panel.cell_y * 3 * side * side * 3, 0);
    if (panel.advice.full_pixel) return stencil;
    const ErrorForm form(panel, eye_responses(panel, ppd, eyes), ErrorForm::period_of(panel, period),
                         eye_reach);
    const Kernel kernel(form);
    const int cx = int(panel.cell_x), cy = int(panel.cell_y);
    for (std::size_t e = 0; e < form.count(); ++e)
        for (std::size_t other = 0; other < form.count(); ++other) {
            const Output &to = form.outputs()[e], &from = form.outputs()[other];
            const std::size_t output = (to.y * panel.cell_x + to.x) * 3 + to.channel;
            for (int dy = -radius; dy <= radius; ++dy)
                for (int dx = -radius; dx <= radius; ++dx) {
                    const int x = int(to.x) + dx, y = int(to.y) + dy;
                    const int right = floor_div(x, cx), below = floor_div(y, cy);
                    if (x - right * cx != int(from.x) || y - below * cy != int(from.y)) continue;
                    const std::size_t row = output * side + std::size_t(dy + radius);
                    stencil.weights[(row * side + std::size_t(dx + radius)) * 3 + from.channel] =
                        float(window(dx) * window(dy) * kernel.at(e, other, right, below));
                }
        }
    return stencil;
}

}  // namespace triad
