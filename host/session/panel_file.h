#pragma once
#include <string>

#include "panel/panel.h"

namespace triad {

/// A built-in panel ("qd-oled", "rgb@180"), or the one of a panel.json. Throws Error(usage) for a name that
/// is neither, Error(scene) for a file that is no panel.
Panel panel_named(const std::string& name_or_file);

}  // namespace triad
