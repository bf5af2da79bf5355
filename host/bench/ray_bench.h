#pragma once
/// Rays per second by kind, scene and format of nodes.
#include <functional>
#include <string>
#include <vector>

#include "bench/board.h"
#include "device/device.h"

namespace triad {

/// Rows of the rays of the camera, of diffuse surfaces and to a light, for every format of nodes; formats
/// take turns. All must hit the same, bit by bit: rows of another are not right. `go_on` is asked after each
/// round, of which there is one at least. The device walks the nodes that it did before.
std::vector<BoardRow> measure_rays(Device& device, const std::string& scene, unsigned size,
                                   const std::function<bool()>& go_on);

}  // namespace triad
