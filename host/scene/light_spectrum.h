#pragma once
/// Spectra that lights have of their own. Light without one is D65, tinted by its colour.
#include <string>
#include <vector>

namespace triad {

/// How the power of a light is spread over the wavelength; its strength and tint are elsewhere.
struct LightSpectrum {
    enum class Law : int {
        equal_energy,  ///< "E": the same at every wavelength
        blackbody,     ///< Planck's law at `temperature`
        lines          ///< lines 1 nm wide at half of their height; one of them is a laser
    };
    struct Line {
        double nanometres, power;  ///< power in any unit
        bool operator==(const Line&) const = default;
    };
    Law law = Law::equal_energy;
    double temperature = 0;  ///< kelvin
    std::vector<Line> lines;

    bool operator==(const LightSpectrum&) const = default;

    /// Power per nanometre, in any unit.
    double power(double nanometres) const;
    /// True when wavelengths are visible, powers and temperature are sane, and some power is positive.
    bool is_sane() const;

    static constexpr double least_temperature = 500, most_temperature = 1e6;
};

/// The names that stand for a spectrum without numbers: "D65, E".
std::string light_spectrum_names();

}  // namespace triad
