#pragma once
/// Runs as CSV and back, as text.
#include <span>
#include <string>
#include <string_view>

#include "bench/error_bench.h"

namespace triad {

/// A line of names, then a line per row (RFC 4180). Numbers are written so that they come back exactly.
std::string csv_of(std::span<const ErrorRun> runs);

/// Columns are found by name, others are ignored. Throws Error(scene) that names the line for anything that
/// csv_of() could not have written; `name` is for the sentence.
std::vector<ErrorRun> runs_from_csv(const std::string& name, std::string_view text);

}  // namespace triad
