#pragma once
/// --reconstruct and what goes with it, for `triad render` and `triad resolve`.
#include <CLI/CLI.hpp>

#include "session/reconstruct_request.h"

namespace triad {

/// Declares --reconstruct, --bins, --filter, --panel, --ppd, --distance, --pitch and --refine.
void declare(CLI::App& command, ReconstructRequest& request);

}  // namespace triad
