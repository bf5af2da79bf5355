#pragma once
/// The sRGB transfer curve (IEC 61966-2-1:1999).
#include <cmath>

namespace triad {

/// Display-linear [0, 1] to the encoded value that files and displays hold.
inline double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

inline double srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace triad
