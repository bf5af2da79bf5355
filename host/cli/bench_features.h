#pragma once
/// triad bench features: what each compile-time feature costs on a device and driver.
#include <CLI/CLI.hpp>

#include "base/error.h"

namespace triad {

/// `triad bench features`.
void add_bench_features(CLI::App& bench, Exit& exit);

}  // namespace triad
