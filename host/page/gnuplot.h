#pragma once
/// Plots by gnuplot, a child process, as SVG that follows the reader's choice of light or dark.
#include <cstddef>
#include <string>

namespace triad {

/// Okabe and Ito 2008 without its yellow, the strongest first; settings also differ by dash and by marker.
/// Beyond pen_count they begin again.
struct Pen {
    const char *light, *dark;  // "rgb(  r, g, b)" as gnuplot writes it, and what a dark page shows instead
    const char* colour;
};
constexpr std::size_t pen_count = 7;
/// Of the i-th curve.
const Pen& pen_of(std::size_t i);

/// What a script begins with: the size in pixels, fonts, title and grid.
std::string plot_head(const std::string& title, double height);

/// A name as a gnuplot string, of which gnuplot expands nothing.
std::string gnuplot_quoted(const std::string& name);

/// The SVG; empty where it cannot be drawn, and `missing` says why. `name`: for that.
std::string draw_with_gnuplot(const std::string& script, const std::string& name, std::string& missing);

}  // namespace triad
