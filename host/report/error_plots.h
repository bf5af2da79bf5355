#pragma once
/// The plots of an error report, drawn by gnuplot as a child process.
#include <string>
#include <vector>

#include "bench/error_bench.h"

namespace triad {

struct ErrorPlot {
    std::string file;   ///< name of the SVG file
    std::string scene;  ///< "": all scenes
    std::string words;  ///< what it shows, for who cannot see it
    std::string svg;
};

struct ErrorPlots {
    std::vector<ErrorPlot> plots;
    std::string missing;  ///< a sentence why there are none, or not all
};

/// For each scene error against samples and against time, then efficiency of everything.
ErrorPlots draw_error_plots(const ErrorBench& bench);

/// The script of one plot, with its data inside. `on_time`: against seconds, else against samples per pixel.
std::string error_plot_script(const ErrorBench& bench, const std::string& scene, bool on_time);
/// A line for each scene and setting, a point with its interval on a logarithmic axis.
std::string efficiency_plot_script(const ErrorBench& bench, const std::string& unit);

}  // namespace triad
