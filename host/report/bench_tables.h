#pragma once
/// What `triad bench error` prints and writes: a table for people, rows for programs.
#include <string>

#include "bench/error_bench.h"
#include "bench/error_score.h"
#include "report/report.h"

namespace triad {

/// A line for the last budget of every curve, and one for every change. Ends with a line end.
std::string table_of(const ErrorBench& bench);

/// A line for every score; nothing when there is none.
std::string table_of(const std::vector<SettingScore>& scores);

/// The rows of triad.bench-error/1: one for each point of each curve.
Json rows_of(const ErrorBench& bench);

/// Its other members: curves, scenes, settings, changes, and the scores of a suite.
Json details_of(const ErrorBench& bench, const std::vector<SettingScore>& scores);

}  // namespace triad
