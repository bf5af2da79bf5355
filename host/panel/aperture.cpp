#include "panel/aperture.h"

#include <algorithm>
#include <cmath>

namespace triad {
namespace {

using Polygon = std::vector<dvec2>;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Signed by the order of the corners.
double area(const Polygon& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
    return twice / 2;
}

/// The part where side * (p[axis] - limit) >= 0 (Sutherland & Hodgman 1974). Concave polygons may keep edges
/// of no area.
Polygon cut(const Polygon& p, int axis, double limit, double side) {
    Polygon result;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const dvec2 &a = p[i], &b = p[(i + 1) % p.size()];
        const double da = side * (a[axis] - limit), db = side * (b[axis] - limit);
        if (da >= 0) result.push_back(a);
        if ((da >= 0) != (db >= 0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

/// A disc as a polygon of its area.
Polygon polygon_of(const Aperture& aperture) {
    if (!aperture.corners.empty()) return aperture.corners;
    constexpr unsigned corners = 96;
    constexpr double angle = 2 * pi / corners;
    const double radius = aperture.radius * std::sqrt(angle / std::sin(angle));
    Polygon p;
    for (unsigned i = 0; i < corners; ++i)
        p.push_back(radius * dvec2(std::cos(i * angle), std::sin(i * angle)));
    return p;
}

}  // namespace

double aperture_area(const Aperture& aperture) {
    return aperture.corners.empty() ? pi * aperture.radius * aperture.radius
                                    : std::abs(area(aperture.corners));
}

dvec2 aperture_centroid(const Aperture& aperture) {
    const Polygon& p = aperture.corners;
    dvec2 sum{0};
    for (std::size_t i = 0; i < p.size(); ++i) {
        const dvec2 &a = p[i], &b = p[(i + 1) % p.size()];
        sum += (a + b) * cross(a, b);
    }
    return p.empty() ? dvec2(0) : sum / (6 * area(p));
}

std::complex<double> aperture_transform(const Aperture& aperture, const dvec2& f) {
    const dvec2 k = 2 * pi * f;
    const double k2 = glm::dot(k, k);
    if (k2 < 1e-12) return 1;
    if (aperture.corners.empty()) {
        const double x = std::sqrt(k2) * aperture.radius;
        return x < 1e-6 ? 1.0 : 2 * ::j1(x) / x;
    }
    // The divergence theorem on k exp(-i k x): an integral along the edges, each in closed form.
    const Polygon& p = aperture.corners;
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const dvec2 &a = p[i], &b = p[(i + 1) % p.size()];
        const double half = glm::dot(k, b - a) / 2;
        const double sinc = std::abs(half) < 1e-9 ? 1 : std::sin(half) / half;
        sum += cross(k, b - a) * sinc * std::polar(1.0, -glm::dot(k, a + b) / 2);
    }
    return std::complex<double>(0, 1) * sum / (k2 * area(p));
}

double aperture_overlap(const Aperture& aperture, const dvec2& lo, const dvec2& hi) {
    Polygon p = polygon_of(aperture);
    for (int axis = 0; axis < 2 && !p.empty(); ++axis) p = cut(cut(p, axis, lo[axis], 1), axis, hi[axis], -1);
    return std::abs(area(p));
}

}  // namespace triad
