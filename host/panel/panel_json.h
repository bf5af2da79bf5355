#pragma once
/// panel.json: a display in a file (docs/subpixel.md has its members).
#include <string>
#include <string_view>

#include "panel/panel.h"

namespace triad {

/// Throws Error(scene) that names the member at fault, `where` first: text that is not JSON, members that are
/// unknown, missing or of another type, and what check_panel refuses.
Panel panel_of_json(std::string_view text, const std::string& where);

/// The panel as it lies on the screen, indented.
std::string json_of_panel(const Panel& panel);

}  // namespace triad
