#pragma once
/// What `triad bench error` prints and writes: a table for people, rows for programs.
#include <string>

#include "app/report.h"
#include "measure/error_bench.h"

namespace triad {

/// A line for the last budget of every curve, and one for every change. Ends with a line end.
std::string table_of(const ErrorBench& bench);

/// The rows of triad.bench-error/1: one for each point of each curve.
Json rows_of(const ErrorBench& bench);

/// Its other members: curves, scenes, settings, changes.
Json details_of(const ErrorBench& bench);

}  // namespace triad
