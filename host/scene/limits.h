#pragma once
/// How large numbers may be that reach a kernel as float: files are refused beyond (validate(), exit 2), and
/// options (check_limits() of render/settings.h and the command line, exit 1). Kernels survive any bits, but
/// what they compute there is no picture.
#include <cstdio>
#include <string>

namespace triad::limits {

/// Coordinates of vertices, lights and cameras, in scene units.
inline constexpr double coordinate = 1e11;
/// Coordinates where a ray may start: the eye, around it the lens or an orthographic picture. The triangle
/// test multiplies three lengths: with differences of coordinates up to d, sheared ones are below 2 d, edge
/// functions below 8 d^2 and the sum that gives t below 24 d^3, here 3e37; float ends at 3.4e38. (Measured: a
/// scene enlarged to 1e12 keeps its picture bit for bit, at 1e13 it loses parts.)
inline constexpr double ray_start = 1e12;
/// Other numbers that are squared, or divided by: float holds the square of 1e18.
inline constexpr double squared = 1e18;
/// Radiances and intensities, which are multiplied by factors alone; the sun in candela has 3e27.
inline constexpr double brightness = 1e30;

/// A limit, or what is beyond it, in a sentence: "1e+11".
inline std::string text_of(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", x);
    return text;
}

}  // namespace triad::limits
