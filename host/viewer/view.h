#pragma once
/// `triad view`: a page on this machine that shows a picture while it grows.
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "session/render_request.h"

namespace triad {

struct ViewRequest {
    RenderRequest render;      ///< scene, camera, picture and device; it writes no files
    unsigned port = 0;         ///< 0: any that is free
    bool open_browser = true;  ///< where there is a desktop to open one on
    /// ViewLoop::Command.
    std::function<std::string(const std::vector<std::string>& options, bool keeps_display)> command;
};

/// Serves the page and renders for it until a signal asks to end. The address is printed on standard output.
/// Throws Error as a render does, and Error(usage) for a port that cannot be had.
Exit view(ViewRequest request);

}  // namespace triad
