// Writes the directional-albedo tables as text, at build time. Quadrature in double over the visible normals
// (Dupuy and Benyoub 2023), where the integrand is G2 / G1 and bounded; midpoints, half the circle by
// symmetry.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernels/types.h"

namespace {

struct Pair {
    double first = 0, second = 0;
};

/// Reflectance of a dielectric interface and the cosine beyond it; eta = index beyond over index before.
double fresnel(double c, double eta, double* refracted) {
    const double sine2 = (1 - c * c) / (eta * eta);
    *refracted = 0;
    if (sine2 >= 1) return 1;
    const double t = *refracted = std::sqrt(1 - sine2);
    const double s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
}

double stretch(double xy2, double z, double alpha) { return std::sqrt(alpha * alpha * xy2 + z * z); }

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
        const double z = (1 - (i + 0.5) / steps) * (1 + wz) - wz, r = std::sqrt((1 - z) * (1 + z));
        for (int j = 0; j < steps; ++j) {
            const double phi = 3.14159265358979323846 * (j + 0.5) / steps;
            double hx = alpha * (r * std::cos(phi) + wx), hy = alpha * r * std::sin(phi), hz = z + wz;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            hx /= length, hz /= length;
            const double c = std::min(1.0, x * hx + mu * hz);
            const Pair value = body(c, hz, masking);
            sum.first += value.first, sum.second += value.second;
        }
    }
    return {sum.first / (double(steps) * steps), sum.second / (double(steps) * steps)};
}

Pair ggx(double mu, double alpha) {
    if (alpha == 0) return {1, std::pow(1 - mu, 5)};
    return integrate(mu, alpha, 128, [&](double c, double hz, const auto& masking) {
        const double g = masking(2 * c * hz - mu);
        return Pair{g, g * std::pow(1 - c, 5)};
    });
}

Pair glass(double mu, double alpha, double eta) {
    if (alpha == 0) return {1, 1};
    return integrate(mu, alpha, 48, [&](double c, double hz, const auto& masking) {
        double t;
        const double f = fresnel(c, eta, &t), reflected = masking(2 * c * hz - mu);
        if (f >= 1) return Pair{reflected, reflected};
        const double transmitted = masking(-((c / eta - t) * hz - mu / eta));
        return Pair{f * reflected + (1 - f) * transmitted, transmitted};
    });
}

void print(Pair p) { std::printf("%.8ef, %.8ef,\n", p.first, p.second); }

}  // namespace

int main() {
    for (int r = 0; r < ALBEDO_SIZE; ++r)
        for (int m = 0; m < ALBEDO_SIZE; ++m) {
            const double root = double(m) / (ALBEDO_SIZE - 1), roughness = double(r) / (ALBEDO_SIZE - 1);
            print(ggx(root * root, roughness * roughness));
        }
    constexpr int n = ALBEDO_GLASS_SIZE - 1;
    for (int inside = 0; inside < 2; ++inside)
        for (int i = 0; i <= n; ++i)
            for (int r = 0; r <= n; ++r)
                for (int m = 0; m <= n; ++m) {
                    const double z = double(ALBEDO_GLASS_MAX) * i * i / (n * n), ior = (1 + z) / (1 - z);
                    const double root = double(m) / n, roughness = double(r) / n;
                    print(glass(root * root, roughness * roughness, inside ? 1 / ior : ior));
                }
}
