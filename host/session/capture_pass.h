#pragma once
/// From a request to a capture: one pass of a render on one device, noted while it is done.
#include "capture/capture.h"
#include "session/render_request.h"

namespace triad {

/// Renders the samples of the request twice on its device, first to measure how large launches are to be,
/// and notes the second time. Throws Error as a render does.
Capture capture_pass(RenderRequest request);

}  // namespace triad
