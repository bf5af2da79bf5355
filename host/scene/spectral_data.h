#pragma once
/// Colour science as tables over the wavelength: 380 to 780 nm in steps of 5 nm, straight lines between.
#include <array>

#include "base/math.h"

namespace triad {

inline constexpr int spectral_rows = 81;
inline constexpr double spectral_step = 5;  ///< nanometres

/// The CIE 1931 colour matching functions of the 2 degree observer (CIE 015, table of 1 nm, every fifth row).
extern const std::array<double, 3> cie_1931[spectral_rows];
/// CIE standard illuminant D65, 100 at 560 nm.
extern const double cie_d65[spectral_rows];
/// What the primaries of Rec.709 reflect, so that colours upsample to smooth reflectances in [0, 1]; they add
/// up to 1 (Mallett and Yuksel 2019, "Spectral Primary Decomposition for Rendering with sRGB Reflectance").
extern const std::array<double, 3> mallett_yuksel[spectral_rows];

/// A row's wavelength in nanometres.
constexpr double wavelength_of_row(int row) { return 380 + spectral_step * row; }

/// The integral over the wavelength of values that are linear between the rows.
template <class Value>
auto integrate_rows(const Value& value) {
    auto sum = (value(0) + value(spectral_rows - 1)) * 0.5;
    for (int i = 1; i + 1 < spectral_rows; ++i) sum += value(i);
    return sum * spectral_step;
}

/// From CIE XYZ to linear Rec.709 with the white that D65 has by these very tables (.95043, 1, 1.0888), so
/// that D65 is (1, 1, 1) exactly.
dmat3 rec709_from_xyz();

/// The linear Rec.709 colour that a row's wavelength adds, per nanometre, to light whose spectrum is D65 and
/// whose colour is (1, 1, 1). Signed: pure wavelengths lie outside Rec.709. Integrates to (1, 1, 1).
dvec3 d65_response(int row);

}  // namespace triad
