// Tables over the wavelength: what paths draw theirs from, what they add to the picture, and indices.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/pack.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

static_assert(SPECTRUM_ROWS == spectral_rows);

using Rows = std::array<double, spectral_rows>;

/// Wavelengths at equal steps of the distribution whose density is proportional to `density`, which is linear
/// between the rows: within a row, the root of t d0 + t^2 (d1 - d0) / 2 = what is left.
void invert(const Rows& density, float* nodes) {
    Rows sum{};
    for (int i = 1; i < spectral_rows; ++i) sum[i] = sum[i - 1] + 0.5 * (density[i - 1] + density[i]);
    int row = 0;
    for (int k = 0; k < WAVELENGTH_NODES; ++k) {
        const double wanted = sum.back() * k / (WAVELENGTH_NODES - 1);
        while (row < spectral_rows - 2 && sum[row + 1] < wanted) ++row;
        const double left = wanted - sum[row], d0 = density[row], slope = density[row + 1] - d0;
        const double root = std::sqrt(std::max(0.0, d0 * d0 + 2 * slope * left));
        const double t = d0 + root > 0 ? 2 * left / (d0 + root) : 0.0;
        nodes[k] = static_cast<float>(wavelength_of_row(row) + spectral_step * std::clamp(t, 0.0, 1.0));
    }
}

dev::Spectrum spectrum_of(const std::array<dvec3, spectral_rows>& filter, const Rows& density) {
    dev::Spectrum s{};
    invert(density, s.wavelength);
    for (int i = 0; i < spectral_rows; ++i)
        for (int c = 0; c < 3; ++c) {
            const auto& basis = mallett_yuksel[i];
            s.filter[i][c] = static_cast<float>(filter[i][c]);
            s.basis[i][c] = static_cast<float>(basis[c] / (basis[0] + basis[1] + basis[2]));
        }
    return s;
}

/// The exact filter (numerics of docs/spectral.md): a wavelength's share of D65, drawn by its length.
dev::Spectrum exact_spectrum() {
    std::array<dvec3, spectral_rows> filter;
    Rows density;
    for (int i = 0; i < spectral_rows; ++i) {
        filter[i] = d65_response(i);
        density[i] = glm::length(filter[i]);
    }
    return spectrum_of(filter, density);
}

/// The filter as it was first published: the observer's response in RGB, cut at 0 and scaled so that each
/// channel's mean over the spectrum is 1; drawn by the mean of x, y and z.
dev::Spectrum classic_spectrum() {
    const dmat3 to_rgb = rec709_from_xyz();
    std::array<dvec3, spectral_rows> filter;
    Rows density;
    for (int i = 0; i < spectral_rows; ++i) {
        const dvec3 xyz(cie_1931[i][0], cie_1931[i][1], cie_1931[i][2]);
        filter[i] = glm::max(to_rgb * xyz, dvec3(0.0));
        density[i] = (xyz.x + xyz.y + xyz.z) / 3;
    }
    const dvec3 sum = integrate_rows([&](int i) { return filter[i]; });
    for (dvec3& f : filter) f /= sum;
    return spectrum_of(filter, density);
}

/// n at every row, and its slope there times the step: Hermite's cubic between errs by less than 3e-8.
void add_indices(const Dispersion& d, std::vector<float>& indices) {
    for (int i = 0; i < spectral_rows; ++i) {
        const double w = wavelength_of_row(i), h = 0.01;
        indices.push_back(static_cast<float>(d.index(w)));
        indices.push_back(static_cast<float>((d.index(w + h) - d.index(w - h)) / (2 * h) * spectral_step));
    }
}

}  // namespace

void pack_spectrum(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    if (settings.spectral == Spectral::off) return;
    bool any = settings.spectral == Spectral::classic || settings.spectral == Spectral::full;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!scene.materials[i].dispersion) continue;
        packed.materials[i].dispersion =
            static_cast<std::uint32_t>(packed.indices.size() / (2 * spectral_rows));
        add_indices(*scene.materials[i].dispersion, packed.indices);
        any = true;
    }
    if (any)
        packed.spectrum = {settings.spectral == Spectral::classic ? classic_spectrum() : exact_spectrum()};
}

}  // namespace triad
