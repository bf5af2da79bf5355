#pragma once
/// How pictures are written, for `triad render` and `triad resolve`.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "session/output.h"

namespace triad {

/// Declares --exposure, --tonemap, --bits and --half.
void declare_style(CLI::App& command, OutputStyle& style);
/// Warns of what is asked of files of a kind that is not among `outputs`. `is_display_linear`: whether EXR
/// files hold what a display shows (Reconstruction); asked only where that matters.
void warn_of_idle(const OutputStyle& style, const std::vector<std::string>& outputs,
                  const std::function<bool()>& is_display_linear);
/// --background of what is rendered already.
void declare_background(CLI::App& command, OutputStyle& style);

}  // namespace triad
