#pragma once
/// Directional albedos of lobes. Quadrature in double over the visible normals (Dupuy and Benyoub 2023),
/// where the integrand is G2 / G1 and bounded; midpoints, half the circle by symmetry. Heights over the
/// lowest normal are t^2: the few normals that lean so far that light ends in the surface decide what is lost
/// at low roughness.
#include <algorithm>
#include <cmath>

#include "kernels/types.h"

namespace triad::albedo {

constexpr double pi = 3.14159265358979323846;

struct Pair {
    double first = 0, second = 0;
};

/// Reflectance of a dielectric interface and the cosine beyond it; eta = index beyond over index before.
inline double fresnel(double c, double eta, double* refracted) {
    const double sine2 = (1 - c * c) / (eta * eta);
    *refracted = 0;
    if (sine2 >= 1) return 1;
    const double t = *refracted = std::sqrt(1 - sine2);
    const double s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
}

inline double schlick(double c) { return (1 - c) * (1 - c) * (1 - c) * (1 - c) * (1 - c); }

inline double stretch(double xy2, double z, double alpha) { return std::sqrt(alpha * alpha * xy2 + z * z); }

/// Normals h before they have length 1, on a ring about the mirrored view, u the cosine of how far around:
/// wo.h = a + b u, |h|^2 = c + d u.
struct Ring {
    double a, b, c, d;

    /// Where wo.h / |h| passes a cosine: turns between 0 and pi, these first and last.
    struct Cuts {
        double at[4] = {0};
        int count = 1;
    };
    Cuts cuts(double cosine) const {
        const double c2 = cosine * cosine, half = a * b - c2 * d / 2, constant = a * a - c2 * c,
                     root2 = half * half - b * b * constant;
        Cuts cuts;
        if (cosine > 0 && b > 0 && root2 > 0) {
            const double q = -(half + std::copysign(std::sqrt(root2), half));
            double upper = q / (b * b), lower = constant / q;
            if (upper < lower) std::swap(upper, lower);
            for (double u : {upper, lower})
                if (u > -1 && u < 1 && a + b * u > 0) cuts.at[cuts.count++] = std::acos(u);
        }
        cuts.at[cuts.count++] = pi;
        return cuts;
    }
};

/// body(wo.h, h.z, masking) summed over visible normals with equal weight; masking(z) gives G2 / G1 of a
/// direction of that z. For what begins at the cosine wo.h = `edge` as the square root of the distance to it,
/// rings are cut there and places crowd to the cut; there is none if it is 0.
template <class Body>
Pair integrate(double mu, double alpha, int heights, int turns, double edge, Body body) {
    const double x = std::sqrt(1 - mu * mu), s_o = stretch(x * x, mu, alpha);
    const double wx = alpha * x / s_o, wz = mu / s_o;
    const auto masking = [&](double z) {
        const double s_i = stretch(std::max(0.0, 1 - z * z), z, alpha);
        return z > 0 ? z * (mu + s_o) / (z * s_o + mu * s_i) : 0.0;
    };
    Pair sum;
    for (int i = 0; i < heights; ++i) {
        const double t = (i + 0.5) / heights, z = t * t * (1 + wz) - wz, r2 = (1 - z) * (1 + z),
                     r = std::sqrt(r2), hz = z + wz;
        const Ring ring{alpha * x * wx + mu * hz, alpha * x * r, alpha * alpha * (r2 + wx * wx) + hz * hz,
                        2 * alpha * alpha * r * wx};
        const Ring::Cuts cuts = ring.cuts(edge);
        for (int k = 0; k + 1 < cuts.count; ++k) {
            const bool after = k > 0, before = k + 2 < cuts.count;  // a cut, not an end of the half circle
            const double arc = cuts.at[k + 1] - cuts.at[k];
            for (int j = 0; j < turns; ++j) {
                const double w = (j + 0.5) / turns;
                const double f = after    ? (before ? w * w * (3 - 2 * w) : w * w)
                                 : before ? w * (2 - w)
                                          : w,
                             df = after    ? (before ? 6 * w * (1 - w) : 2 * w)
                                  : before ? 2 * (1 - w)
                                           : 1;
                const double u = std::cos(cuts.at[k] + arc * f), length = std::sqrt(ring.c + ring.d * u);
                const Pair value = body(std::min(1.0, (ring.a + ring.b * u) / length), hz / length, masking);
                const double weight = 2 * t * df * arc / pi;
                sum.first += weight * value.first, sum.second += weight * value.second;
            }
        }
    }
    return {sum.first / (double(heights) * turns), sum.second / (double(heights) * turns)};
}

inline Pair ggx(double mu, double alpha, int steps = 128) {
    return integrate(mu, alpha, steps, steps, 0, [&](double c, double hz, const auto& masking) {
        const double g = masking(2 * c * hz - mu);
        return Pair{g, g * schlick(c)};
    });
}

/// From inside (eta < 1) total reflection ends at a cosine, and with 64 x 64 even places that costs 0.5 %.
inline Pair glass(double mu, double alpha, double eta) {
    const bool inside = eta < 1;
    return integrate(mu, alpha, inside ? 128 : 64, inside ? 24 : 32, inside ? std::sqrt(1 - eta * eta) : 0,
                     [&](double c, double hz, const auto& masking) {
                         double t;
                         const double f = fresnel(c, eta, &t), reflected = masking(2 * c * hz - mu);
                         if (f >= 1) return Pair{reflected, reflected};
                         const double transmitted = masking(-((c / eta - t) * hz - mu / eta));
                         return Pair{f * reflected + (1 - f) * transmitted, transmitted};
                     });
}

/// GGX stretched to alpha_x along x, wo at the azimuth phi.
inline Pair stretched(double mu, double phi, double alpha_x, double alpha_y) {
    constexpr int steps = 32;
    const double side = std::sqrt(1 - mu * mu), ox = side * std::cos(phi), oy = side * std::sin(phi);
    const auto stretch_xy = [&](double x, double y, double z) {
        return std::sqrt(alpha_x * alpha_x * x * x + alpha_y * alpha_y * y * y + z * z);
    };
    const double s_o = stretch_xy(ox, oy, mu), wx = alpha_x * ox / s_o, wy = alpha_y * oy / s_o,
                 wz = mu / s_o;
    Pair sum;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, z = t * t * (1 + wz) - wz, r = std::sqrt((1 - z) * (1 + z));
        for (int j = 0; j < 2 * steps; ++j) {
            const double turn = pi * (j + 0.5) / steps;
            double hx = alpha_x * (r * std::cos(turn) + wx), hy = alpha_y * (r * std::sin(turn) + wy),
                   hz = z + wz;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            hx /= length, hy /= length, hz /= length;
            const double c = std::min(1.0, ox * hx + oy * hy + mu * hz), iz = 2 * c * hz - mu;
            if (iz <= 0) continue;
            const double s_i = stretch_xy(2 * c * hx - ox, 2 * c * hy - oy, iz);
            const double g = 2 * t * iz * (mu + s_o) / (iz * s_o + mu * s_i);
            sum.first += g, sum.second += g * schlick(c);
        }
    }
    return {sum.first / (2.0 * steps * steps), sum.second / (2.0 * steps * steps)};
}

/// The sheen lobe of kernels/shading/sheen.h, over directions: z = t^2 resolves the rim.
inline double sheen(double mu, double roughness) {
    constexpr int steps = 96;
    const double alpha = roughness * roughness, t = (1 - alpha) * (1 - alpha);
    const auto mix = [t](double a, double b) { return a + (b - a) * t; };
    const auto fit = [&](double x) {
        return mix(21.5473, 25.3245) / (1 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
               mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
    };
    const auto lambda = [&](double c) { return std::exp(c < 0.5 ? fit(c) : 2 * fit(0.5) - fit(1 - c)); };
    const double side = std::sqrt(1 - mu * mu);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps, z = root * root, r = std::sqrt(1 - z * z),
                     lambda_i = lambda(z);
        for (int j = 0; j < steps; ++j) {
            const double phi = pi * (j + 0.5) / steps;
            const double hx = side + r * std::cos(phi), hy = r * std::sin(phi), hz = mu + z;
            const double sine2 = (hx * hx + hy * hy) / (hx * hx + hy * hy + hz * hz);
            sum += std::pow(sine2, 0.5 / alpha) * 2 * root / (4 * mu * (1 + lambda(mu) + lambda_i));
        }
    }
    return (2 + 1 / alpha) * sum / (double(steps) * steps);  // 2 pi of directions over the 2 pi of D
}

}  // namespace triad::albedo
