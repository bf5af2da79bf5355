#pragma once
/// How pictures are written, for `triad render` and `triad resolve`.
#include <CLI/CLI.hpp>

#include "session/output.h"

namespace triad {

/// Declares --exposure, --tonemap, --bits and --half.
void declare_style(CLI::App& command, OutputStyle& style);
/// --background of what is rendered already.
void declare_background(CLI::App& command, OutputStyle& style);

}  // namespace triad
