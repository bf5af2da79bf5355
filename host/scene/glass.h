#pragma once
/// How the index of refraction depends on the wavelength, and a catalogue of glasses.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace triad {

/// Limits of what is taken as visible, in nanometres: everything spectral lives between them.
inline constexpr double shortest_wavelength = 380, longest_wavelength = 780;
/// Fraunhofer's lines, in nanometres.
inline constexpr double line_F = 486.1327, line_d = 587.5618, line_C = 656.2725;

/// n over the wavelength. Formulas take l in micrometres, as catalogues do.
struct Dispersion {
    enum class Law : int {
        sellmeier,  ///< n^2 = a + sum b_i l^2 / (l^2 - c_i): c_i in square micrometres, already squared
        cauchy,     ///< n = b_0 + b_1 / l^2 + b_2 / l^4
        abbe,       ///< KHR_materials_dispersion: n_d = a, V_d = b_0; never below 1
        pole        ///< n = a + b_0 / (l - c_0)
    };
    Law law = Law::sellmeier;
    double a = 1;
    std::array<double, 4> b{}, c{};

    /// NaN where the formula has no answer.
    double index(double nanometres) const;
    /// (n_d - 1) / (n_F - n_C); infinite without dispersion.
    double abbe_number() const;
    /// True when n is a number from 1 to most_index for every visible wavelength.
    bool is_sane() const;

    /// Beyond any transparent material, germanium in the infrared included.
    static constexpr double most_index = 10;
};

/// The formula of KHR_materials_dispersion, from n_d >= 1 and its `dispersion` = 20 / V_d > 0.
Dispersion abbe_dispersion(double index_d, double dispersion);

/// A glass by name. Sources: docs/spectral.md.
struct Glass {
    const char* name;
    Dispersion dispersion;
};

std::span<const Glass> glass_catalogue();
/// By name; capitals, spaces and underscores (for "-") do not matter.
std::optional<Dispersion> find_glass(std::string_view name);
/// "SF10, N-SF10, ...", for messages.
std::string glass_names();

}  // namespace triad
