#pragma once
/// triad bench device: everything that is to be known of a new board.
#include <CLI/CLI.hpp>

#include "base/error.h"

namespace triad {

void add_bench_device(CLI::App& bench, Exit& exit);

}  // namespace triad
