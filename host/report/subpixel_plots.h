#pragma once
/// Plots of the subpixel bench as SVG, 420 px wide and larger where there is room. They take the colour of
/// the text around them, so that they are right in the light, in the dark and in print; each method has a
/// letter.
#include <map>
#include <string>
#include <vector>

#include "bench/subpixel_bench.h"

namespace triad {

/// A letter for each method, in the order of their errors: supersampling by any number of rays shares one.
std::map<std::string, char> method_letters(const std::vector<SubpixelRow>& rows);
/// What a method is called in plots: "ssaa:N" for all of supersampling.
std::string method_family(const std::string& method);

/// Methods by their error, least first, with the intervals. Rows of one scene, display, eye and number of
/// rays.
std::string ranked_dots(std::vector<SubpixelRow> rows, const std::map<std::string, char>& letters);

/// Error against seconds, both logarithmic, and the line of those that nothing beats in both. Rows of one
/// scene, display and eye.
std::string error_for_time(const std::vector<SubpixelRow>& rows, const std::map<std::string, char>& letters);

}  // namespace triad
