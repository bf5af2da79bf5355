#pragma once
/// The two forms of the driver `wave` (kernels/path/wave.h). Both compile their kernels here.
#include "trace/path_driver.h"

namespace triad {

/// One launch; each compute unit has a pool of POOL_SLOTS paths.
std::unique_ptr<PathDriver> make_wave(const DeviceScene& scene, const RenderSettings& settings,
                                      const Features& features);

/// A launch per stage, over batch_of(device) paths.
std::unique_ptr<PathDriver> make_wave_stages(const DeviceScene& scene, const RenderSettings& settings,
                                             const Features& features);

}  // namespace triad
