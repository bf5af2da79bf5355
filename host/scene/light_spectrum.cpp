#include "scene/light_spectrum.h"

#include <algorithm>
#include <cmath>

#include "scene/glass.h"

namespace triad {

double LightSpectrum::power(double nanometres) const {
    switch (law) {
        case Law::equal_energy:
            return 1;
        case Law::blackbody: {
            constexpr double second_radiation_constant = 1.438776877e7;  // nm K
            // scaled to 1 at 560 nm, so that no exponential leaves the numbers
            const auto exponent = [&](double w) { return second_radiation_constant / (w * temperature); };
            return std::pow(560 / nanometres, 5) * std::exp(exponent(560) - exponent(nanometres)) *
                   std::expm1(-exponent(560)) / std::expm1(-exponent(nanometres));
        }
        case Law::lines: {
            double sum = 0;
            for (const Line& line : lines) {
                // at the ends of the visible a part of the line is cut off, and the rest has its power
                const double within =
                    std::min(line.nanometres - shortest_wavelength, longest_wavelength - line.nanometres);
                sum += line.power * std::max(0.0, 1 - std::abs(nanometres - line.nanometres)) /
                       std::min(1.0, (1 + within) / 2);
            }
            return sum;
        }
    }
    return 0;
}

bool LightSpectrum::is_sane() const {
    if (law == Law::blackbody) return temperature >= least_temperature && temperature <= most_temperature;
    if (law == Law::equal_energy) return true;
    double total = 0;
    for (const Line& line : lines) {
        if (!(line.nanometres >= shortest_wavelength && line.nanometres <= longest_wavelength)) return false;
        if (!(line.power >= 0 && line.power <= 1e30)) return false;
        total += line.power;
    }
    return total >= 1e-30;
}

std::string light_spectrum_names() { return "D65, E"; }

}  // namespace triad
