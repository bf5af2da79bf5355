#pragma once
/// The options of `triad render` on the command line.
#include <CLI/CLI.hpp>

#include "session/render_request.h"

namespace triad {

/// What is rendered and on which device: all options of render but those on what is written. As declare().
void declare_workload(CLI::App& command, RenderRequest& request);

/// Declares the options on a subcommand. `request` must outlive the parsing; complete() it afterwards.
void declare(CLI::App& command, RenderRequest& request);

/// The options of the scene's file, and of what is written; parts of declare().
void declare_scene(CLI::App& command, RenderRequest& request);
void declare_outputs(CLI::App& command, RenderRequest& request);

}  // namespace triad
