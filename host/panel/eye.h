#pragma once
/// Models of the eye: how much of a pattern's contrast it sees, by spatial frequency, in three opponent
/// channels (lightness, red-green, blue-yellow).
#include <optional>
#include <string>

#include "base/math.h"

namespace triad {

enum class Eye {
    /// S-CIELAB (Zhang & Wandell 1996), with its published spreads; the third Gaussian of lightness, an
    /// inhibition
    /// over 4 degrees, is left out. Blurry; confirmed on subpixel text (Farrell et al. 2011).
    scielab,
    /// iCID's (Preiss, Fernandes & Urban 2014): sharp in lightness.
    sharp,
    /// FLIP's (Andersson et al. 2020): red-green nearly as sharp as lightness.
    flip
};

/// "scielab", "sharp", "flip".
std::optional<Eye> eye_named(const std::string& name);
const char* eye_name(Eye eye);

/// How much the error that each eye sees counts in what is minimised. S-CIELAB's eye is the one that tests
/// with people have confirmed; a little of the others keeps patterns in check that it is blind to, and costs
/// it nearly nothing (docs/decisions/subpixel.md).
struct EyeShares {
    double scielab = 1, sharp = 0.03, flip = 0.15;
};

/// Opponent colours from CIE XYZ relative to white (Y of white = 1).
dmat3 opponent_of_xyz(Eye eye, const dvec3& white);

/// The share of contrast that is seen in each opponent channel at a frequency in cycles per degree; 1 at 0.
dvec3 contrast_sensitivity(Eye eye, double cycles_per_degree);

/// Axes in which one unit is about one CIELAB unit at mid grey, linear in XYZ: 116 Y, 500 (X/Xn - Y),
/// 200 (Y - Z/Zn) (FLIP's YCxCz).
dmat3 linear_lab_of_xyz(const dvec3& white);

/// CIE 1976 L*, a*, b* (ISO/CIE 11664-4).
dvec3 lab_of_xyz(const dvec3& xyz, const dvec3& white);

/// What the eye makes of XYZ at a frequency, in linear Lab axes: linear_lab T^-1 diag(sensitivity) T.
class EyeResponse {
  public:
    EyeResponse(Eye eye, const dvec3& white);
    dmat3 at(double cycles_per_degree) const;

  private:
    Eye eye_;
    dmat3 from_opponent_, to_opponent_;
};

}  // namespace triad
