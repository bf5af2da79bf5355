#pragma once
/// triad bench kernels: what one evaluation of each function costs, one item at a time and in work-groups.
#include <CLI/CLI.hpp>

#include "base/error.h"

namespace triad {

/// `triad bench kernels`.
void add_bench_kernels(CLI::App& bench, Exit& exit);

}  // namespace triad
