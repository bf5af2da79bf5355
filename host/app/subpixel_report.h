#pragma once
/// The subpixel bench as CSV, JSON rows, plots and a page.
#include <filesystem>
#include <string>
#include <vector>

#include "app/report.h"
#include "measure/subpixel_bench.h"

namespace triad {

struct SubpixelReport {
    SubpixelPlan plan;
    std::vector<SubpixelRow> rows;
    std::string command, date;  ///< for the page
};

Json rows_of(const SubpixelReport& report);
std::string csv_of(const SubpixelReport& report);
/// One line a scene and eye: errors of the best methods at the most rays; then every row that beats triad.
std::string summary_of(const SubpixelReport& report);

/// Writes FOLDER/report.html and a plot of each scene as FOLDER/*.svg. Without gnuplot there are no plots,
/// and a warning.
void write_subpixel_report(const std::filesystem::path& folder, const SubpixelReport& report);

}  // namespace triad
