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

inline double stretch(double xy2, double z, double alpha) { return std::sqrt(alpha * alpha * xy2 + z * z); }

/// body(wo.h, h.z, reflected, transmitted) summed over visible normals with equal weight; `reflected` and
/// `transmitted` give G2 / G1 of the mirrored direction, and of the refracted one whose z is passed.
template <class Body>
Pair integrate(double mu, double alpha, int steps, Body body) {
    const double x = std::sqrt(1 - mu * mu), s_o = stretch(x * x, mu, alpha);
    const double wx = alpha * x / s_o, wz = mu / s_o;
    const auto masking = [&](double z) {
        const double s_i = stretch(std::max(0.0, 1 - z * z), z, alpha);
        return z > 0 ? z * (mu + s_o) / (z * s_o + mu * s_i) : 0.0;
    };
    Pair sum;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, z = t * t * (1 + wz) - wz, r = std::sqrt((1 - z) * (1 + z));
        for (int j = 0; j < steps; ++j) {
            const double phi = pi * (j + 0.5) / steps;
            double hx = alpha * (r * std::cos(phi) + wx), hy = alpha * r * std::sin(phi), hz = z + wz;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            hx /= length, hz /= length;
            const double c = std::min(1.0, x * hx + mu * hz);
            const Pair value = body(c, hz, masking);
            sum.first += 2 * t * value.first, sum.second += 2 * t * value.second;
        }
    }
    return {sum.first / (double(steps) * steps), sum.second / (double(steps) * steps)};
}

inline Pair ggx(double mu, double alpha, int steps = 128) {
    return integrate(mu, alpha, steps, [&](double c, double hz, const auto& masking) {
        const double g = masking(2 * c * hz - mu);
        return Pair{g, g * std::pow(1 - c, 5)};
    });
}

inline Pair glass(double mu, double alpha, double eta) {
    return integrate(mu, alpha, 64, [&](double c, double hz, const auto& masking) {
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
            sum.first += g, sum.second += g * std::pow(1 - c, 5);
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
