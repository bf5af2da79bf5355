#pragma once
/// The report of `triad bench error`: one HTML file that needs nothing else, and its plots as SVG files.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/error_bench.h"
#include "bench/error_score.h"

namespace triad {

/// What stands above the tables.
struct ErrorReportHead {
    std::string title;                 ///< "" is replaced by "Error against time"
    std::string command;               ///< as typed
    std::string date;                  ///< any text; "" leaves it out
    std::vector<SettingScore> scores;  ///< of a suite; empty: there is none
};

/// Writes FOLDER/report.html and FOLDER/*.svg (the folder exists) and returns the paths written. Plots are
/// drawn by gnuplot, a child process; without it the report has none and says so, and so does a warning in
/// the log. Throws Error(scene) when a file cannot be written.
std::vector<std::filesystem::path> write_error_report(const std::filesystem::path& folder,
                                                      const ErrorBench& bench, const ErrorReportHead& head);

}  // namespace triad
