#pragma once
/// The subpixel bench as CSV, JSON rows, plots and a page.
#include <filesystem>
#include <string>
#include <vector>

#include "bench/subpixel_bench.h"
#include "report/report.h"

namespace triad {

struct SubpixelReport {
    SubpixelPlan plan;
    std::vector<SubpixelRow> rows;
    std::string command, date;  ///< for the page
    std::vector<SubpixelSight> sights = {};
};

/// Comparisons with triad at equal rays.
struct SubpixelVerdict {
    std::size_t comparisons = 0, worse = 0;  ///< significantly
    std::vector<SubpixelRow> better;         ///< significantly
};
SubpixelVerdict verdict_of(const std::vector<SubpixelRow>& rows);

std::vector<std::string> scenes_of(const std::vector<SubpixelRow>& rows);
bool is_of(const SubpixelRow& row, const PanelView& view);

Json rows_of(const SubpixelReport& report);
std::string csv_of(const SubpixelReport& report);
/// A line for each display, scene and rays: S-CIELAB's errors of all methods, best first; then every row that
/// beats triad.
std::string summary_of(const SubpixelReport& report);

/// Writes FOLDER/report.html and, for the first display, error against time of each scene as FOLDER/*.svg.
void write_subpixel_report(const std::filesystem::path& folder, const SubpixelReport& report);

}  // namespace triad
