#pragma once
/// What the way from bins to drives costs, kernel by kernel: tone maps, taps, refinement.
#include <map>
#include <string>

#include "device/device.h"
#include "display/resolve.h"
#include "metric/repetitions.h"

namespace triad {

/// 3 x 3 bins of noise, 1920 x 270 pixels.
Film noise_film();

/// Milliseconds of each kernel for a megapixel of the film's picture, after a round that compiles. The device
/// must have a profiling queue.
std::map<std::string, Estimate> time_display(Device& device, const Film& film,
                                             const DisplaySettings& settings, unsigned rounds);

}  // namespace triad
