// Tables over the wavelength: what paths draw theirs from, what they add to the picture, and indices.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/error.h"
#include "pack/pack.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

static_assert(SPECTRUM_ROWS == spectral_rows);

static_assert(LIGHT_SPECTRUM_ROWS == (spectral_rows - 1) * int(spectral_step) + 1);

/// Wavelengths at equal steps of the distribution whose density is proportional to `density`, which is linear
/// between rows of `step` nm: within a row, the root of t d0 + t^2 (d1 - d0) / 2 = what is left. Where rows
/// of zero lie between others (lines), each side gets a whole number of steps, and what lies between, one.
void invert(std::span<const double> density, double step, float* nodes) {
    const std::size_t rows = density.size();
    std::vector<double> sum(rows);
    for (std::size_t i = 1; i < rows; ++i) sum[i] = sum[i - 1] + 0.5 * (density[i - 1] + density[i]);
    std::vector<std::pair<std::size_t, std::size_t>> parts;  // first and last row of what is not zero
    for (std::size_t i = 0; i + 1 < rows; ++i) {
        if (!(sum[i + 1] > sum[i])) continue;
        if (parts.empty() || parts.back().second != i) parts.push_back({i, i});
        parts.back().second = i + 1;
    }
    // a part takes three rows of 1 nm at least: there are steps for all
    const std::size_t spare = WAVELENGTH_NODES - 1 - (parts.size() - 1) - parts.size();
    std::size_t given = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [first, last] = parts[i];
        const std::size_t until = i + 1 + std::size_t(std::lround(sum[last] / sum.back() * double(spare)));
        const std::size_t steps = until - given;
        given = until;
        std::size_t row = first;
        for (std::size_t k = 0; k <= steps; ++k) {
            const double wanted = sum[first] + (sum[last] - sum[first]) * double(k) / double(steps);
            while (row + 1 < last && sum[row + 1] < wanted) ++row;
            const double left = wanted - sum[row], d0 = density[row], slope = density[row + 1] - d0;
            const double root = std::sqrt(std::max(0.0, d0 * d0 + 2 * slope * left));
            const double t = d0 + root > 0 ? 2 * left / (d0 + root) : 0.0;
            *nodes++ =
                static_cast<float>(shortest_wavelength + step * (double(row) + std::clamp(t, 0.0, 1.0)));
        }
    }
}

/// What a wavelength adds to the picture, per nm, and the density that it is drawn by.
struct Filter {
    std::array<dvec3, spectral_rows> filter;
    std::array<double, spectral_rows> density;

    dvec3 at(double nanometres) const {
        const double x = (nanometres - shortest_wavelength) / spectral_step;
        const int row = std::clamp(int(x), 0, spectral_rows - 2);
        return glm::mix(filter[row], filter[row + 1], x - row);
    }
};

dev::Spectrum spectrum_of(const Filter& f) {
    dev::Spectrum s{};
    invert(f.density, spectral_step, s.wavelength);
    for (int i = 0; i < spectral_rows; ++i)
        for (int c = 0; c < 3; ++c) {
            const auto& basis = mallett_yuksel[i];
            s.filter[i][c] = static_cast<float>(f.filter[i][c]);
            s.basis[i][c] = static_cast<float>(basis[c] / (basis[0] + basis[1] + basis[2]));
        }
    std::fill(std::begin(s.light), std::end(s.light), 1.0f);
    std::fill(std::begin(s.colour), std::end(s.colour), 1.0f);
    return s;
}

/// The exact filter (numerics of docs/spectral.md): a wavelength's share of D65, drawn by its length.
Filter exact_filter() {
    Filter f;
    for (int i = 0; i < spectral_rows; ++i) {
        f.filter[i] = d65_response(i);
        f.density[i] = glm::length(f.filter[i]);
    }
    return f;
}

/// The filter as it was first published: the observer's response in RGB, cut at 0 and scaled so that each
/// channel's mean over the spectrum is 1; drawn by the mean of x, y and z.
Filter classic_filter() {
    const dmat3 to_rgb = rec709_from_xyz();
    Filter f;
    for (int i = 0; i < spectral_rows; ++i) {
        const dvec3 xyz(cie_1931[i][0], cie_1931[i][1], cie_1931[i][2]);
        f.filter[i] = glm::max(to_rgb * xyz, dvec3(0.0));
        f.density[i] = (xyz.x + xyz.y + xyz.z) / 3;
    }
    const dvec3 sum = integrate_rows([&](int i) { return f.filter[i]; });
    for (dvec3& row : f.filter) row /= sum;
    return f;
}

/// Row by row of 1 nm: the length of what light of this spectrum adds.
std::vector<double> length_of(const dev::Spectrum& s, const Filter& f) {
    std::vector<double> length(LIGHT_SPECTRUM_ROWS);
    for (int i = 0; i < LIGHT_SPECTRUM_ROWS; ++i)
        length[i] = glm::length(f.at(shortest_wavelength + i)) * s.light[i];
    return length;
}

/// Light of this spectrum: over D65, scaled to luminance 1, and its colour under the filter. Both are linear
/// between rows of 1 nm, so that Simpson's rule integrates their product exactly.
dev::Spectrum spectrum_of_light(const LightSpectrum& light, const Filter& f) {
    dev::Spectrum s = spectrum_of(f);
    std::array<double, LIGHT_SPECTRUM_ROWS> over_d65;
    for (int i = 0; i < LIGHT_SPECTRUM_ROWS; ++i) {
        const double w = shortest_wavelength + i, x = i / spectral_step;
        const int row = std::min(int(x), spectral_rows - 2);
        over_d65[i] = light.power(w) / glm::mix(cie_d65[row], cie_d65[row + 1], x - row);
    }
    dvec3 colour(0.0);
    for (int i = 0; i + 1 < LIGHT_SPECTRUM_ROWS; ++i) {
        const dvec3 f0 = f.at(shortest_wavelength + i), f1 = f.at(shortest_wavelength + i + 1);
        const double l0 = over_d65[i], l1 = over_d65[i + 1];
        colour += (f0 * l0 + f1 * l1 + (f0 + f1) * (l0 + l1)) / 6.0;
    }
    const dmat3 to_xyz = glm::inverse(rec709_from_xyz());
    const double luminance = (to_xyz * colour).y;
    for (int i = 0; i < LIGHT_SPECTRUM_ROWS; ++i) s.light[i] = static_cast<float>(over_d65[i] / luminance);
    for (int c = 0; c < 3; ++c) s.colour[c] = static_cast<float>(colour[c] / luminance);
    invert(length_of(s, f), 1, s.wavelength);
    return s;
}

/// Share of the wavelengths of paths that all spectra of lights, and D65, get alike: most of a scene may be
/// lit by what is weak on the whole.
constexpr double wavelengths_for_all = 0.5;

/// n at every row, and its slope there times the step: Hermite's cubic between errs by less than 3e-8.
void add_indices(const Dispersion& d, std::vector<float>& indices) {
    for (int i = 0; i < spectral_rows; ++i) {
        const double w = wavelength_of_row(i), h = 0.01;
        indices.push_back(static_cast<float>(d.index(w)));
        indices.push_back(static_cast<float>((d.index(w + h) - d.index(w - h)) / (2 * h) * spectral_step));
    }
}

}  // namespace

std::vector<float> film_responses() {
    constexpr int parts = 5;  // of a row: cosines of long paths turn within one
    std::vector<float> responses(3 * FILM_ROWS);
    for (int row = 0; row < FILM_ROWS; ++row) {
        dvec3 sum(0.0), whole(0.0);
        for (int i = 0; i + 1 < spectral_rows; ++i)
            for (int part = 0; part < parts; ++part) {
                const double t = (part + 0.5) / parts;
                const dvec3 response = glm::mix(d65_response(i), d65_response(i + 1), t);
                const double wavelength = shortest_wavelength + spectral_step * (i + t);
                sum += response * std::cos(2 * pi * double(FILM_STEP) * row / wavelength);
                whole += response;
            }
        for (int c = 0; c < 3; ++c) responses[std::size_t(3 * row + c)] = float(sum[c] / whole[c]);
    }
    return responses;
}

void pack_film_responses(const Scene& scene, PackedSurfaces& surfaces) {
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.iridescence.has_value(); }))
        return;
    surfaces.film_responses = film_responses();
}

void pack_spectrum(const Scene& scene, const RenderSettings& settings, PackedSurfaces& surfaces) {
    bool wavelengths = settings.spectral == Spectral::classic || settings.spectral == Spectral::full;
    for (std::size_t i = 0; i < scene.materials.size() && settings.spectral != Spectral::off; ++i) {
        if (!scene.materials[i].dispersion) continue;
        surfaces.materials[i].dispersion =
            static_cast<std::uint32_t>(surfaces.indices.size() / (2 * spectral_rows));
        add_indices(*scene.materials[i].dispersion, surfaces.indices);
        wavelengths = true;
    }
    const Filter filter = settings.spectral == Spectral::classic ? classic_filter() : exact_filter();
    if (wavelengths) surfaces.spectrum = {spectrum_of(filter)};

    const auto pack_light = [&](const std::optional<LightSpectrum>& s) {
        if (!s) return;
        for (const PackedLightSpectrum& known : surfaces.light_spectra)
            if (known.spectrum == *s) return;
        const dev::Spectrum light = spectrum_of_light(*s, filter);
        surfaces.light_spectra.push_back(
            {*s, vec3(light.colour[0], light.colour[1], light.colour[2]),
             wavelengths ? static_cast<std::uint32_t>(surfaces.spectrum.size()) : 0});
        if (surfaces.light_spectra.size() >> (32 - LIGHT_SPECTRUM_SHIFT))
            throw Error(Exit::memory, "The lights have more than 65535 different spectra; use fewer.");
        if (wavelengths) surfaces.spectrum.push_back(light);
    };
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        if (m.emission == vec3(0.0f) || m.unlit) continue;
        pack_light(m.emission_spectrum);
        const vec3 colour = light_colour(surfaces, m.emission_spectrum).tint * m.emission;
        for (int c = 0; c < 3; ++c) surfaces.materials[i].emission[c] = colour[c];
    }
    for (const PunctualLight& l : scene.lights) pack_light(l.spectrum);
}

LightColour light_colour(const PackedSurfaces& surfaces, const std::optional<LightSpectrum>& spectrum) {
    if (spectrum)
        for (const PackedLightSpectrum& s : surfaces.light_spectra)
            if (s.spectrum == *spectrum) return {s.colour, s.index ? vec3(1.0f) : s.colour, s.index};
    return {};
}

void pack_wavelengths(PackedScene& packed) {
    if (packed.spectrum.size() < 2) return;
    std::vector<double> weights(packed.spectrum.size(), wavelengths_for_all / double(packed.spectrum.size()));
    for (const dev::Light& l : packed.lights)
        weights[l.flags >> LIGHT_SPECTRUM_SHIFT] += (1 - wavelengths_for_all) * l.pick;
    Filter filter;
    for (int i = 0; i < spectral_rows; ++i)
        filter.filter[i] = {packed.spectrum[0].filter[i][0], packed.spectrum[0].filter[i][1],
                            packed.spectrum[0].filter[i][2]};
    std::vector<double> density(LIGHT_SPECTRUM_ROWS);
    for (std::size_t k = 0; k < packed.spectrum.size(); ++k) {
        const std::vector<double> length = length_of(packed.spectrum[k], filter);
        double sum = 0;
        for (double l : length) sum += l;
        for (std::size_t i = 0; i < length.size(); ++i) density[i] += weights[k] * length[i] / sum;
    }
    invert(density, 1, packed.spectrum[0].wavelength);
}

}  // namespace triad
