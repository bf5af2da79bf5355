#pragma once
/// Options of `triad render` as the kept tables write them: $SCENES, $HARD (generated) and $ASSETS are
/// folders, $ODDS is odds.gltf, which has what no other scene has.
#include <optional>
#include <string>

#include "session/render_request.h"

namespace triad {

/// Whether what was kept is to be replaced instead of compared: the environment variable TRIAD_RENEW is set.
bool renewing();

/// The options with folders in place of their names, for a shell. Writes the hard scenes first if they are
/// named.
std::string with_folders(const std::string& options);
/// The same without those that say how long to render.
RenderRequest scene_options(const std::string& name, const std::string& options);
/// Why these options cannot be rendered here; none: they can.
std::optional<std::string> why_not(const std::string& options);

}  // namespace triad
