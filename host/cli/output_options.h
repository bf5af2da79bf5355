#pragma once
/// How pictures are written, for `triad render` and `triad resolve`.
#include <CLI/CLI.hpp>

#include "session/output.h"

namespace triad {

/// Declares --exposure, --tonemap, --bits and --half.
void declare_style(CLI::App& command, OutputStyle& style);
/// Warns of what is asked of files of a kind that is not among `outputs`. `for_panel`: what EXR files hold is
/// what a display shows.
void warn_of_idle(const OutputStyle& style, const std::vector<std::string>& outputs, bool for_panel);
/// --background of what is rendered already.
void declare_background(CLI::App& command, OutputStyle& style);

}  // namespace triad
