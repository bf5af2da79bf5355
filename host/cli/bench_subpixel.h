#pragma once
#include <CLI/CLI.hpp>

#include "base/error.h"

namespace triad {

/// `triad bench subpixel`.
void add_bench_subpixel(CLI::App& bench, Exit& exit);

}  // namespace triad
