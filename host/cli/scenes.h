#pragma once
/// Several scenes in one command: a render of each, with devices that stay open.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "session/render_request.h"

namespace triad {

/// "out/%s.png" of rooms/hall.glb: "out/hall.png".
std::string named_for(const std::string& path, const std::string& scene);

/// One of the scenes as a render of its own: its files, the words that ask for it alone.
RenderRequest scene_of(const RenderRequest& all, const std::string& scene);

/// Renders one after the other, whatever becomes of the others: `render` takes the request and the command
/// that goes on where it is interrupted. Returns the largest of their exit codes. What ends them all: an
/// interruption, a device that fails. Throws Error(usage) where names do not tell the scenes apart.
Exit for_each_scene(const CLI::App& command, const RenderRequest& all, const std::vector<std::string>& scenes,
                    const std::function<Exit(const RenderRequest&, const std::string&)>& render);

}  // namespace triad
