#pragma once
/// Devices that stay open between the calls of a program.
#include "session/render_session.h"

namespace triad::api {

/// What an earlier render with the same choice of devices left open; empty: nothing did. Nobody else gets it
/// until it is kept again, and not at all where the render that took it fails: a device may be lost.
OpenDevices take_devices(const RenderRequest& request);
void keep_devices(const RenderRequest& request, OpenDevices devices);

}  // namespace triad::api
