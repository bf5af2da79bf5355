#pragma once
/// How pictures are written, for `triad render` and `triad resolve`.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "session/output.h"

namespace triad {

/// Declares --exposure, --tonemap, --bits and --half.
void declare_style(CLI::App& command, OutputStyle& style);
/// Warns of what is asked of files of a kind that is not among `outputs`, where there are any: a film alone
/// keeps what is asked for.
void warn_of_idle(const OutputStyle& style, const std::vector<std::string>& outputs);
/// --background of what is rendered already.
void declare_background(CLI::App& command, OutputStyle& style);

}  // namespace triad
