#pragma once
/// Which work-group size suits this device and driver: drivers that vectorise across work-items run traversal
/// several times slower unless the size is 1, GPUs want a full wave. Measured, never guessed from a name.
#include <cstddef>
#include <vector>

#include "device/device.h"

namespace triad {

struct LocalTiming {
    std::size_t local;
    double seconds;  ///< best of a few launches of intersect_closest over the same rays
};

/// Times intersect_closest with work-groups of 1, 8 and 64 on a generated scene (about half a second).
std::vector<LocalTiming> time_locals(Device& device);

/// Times, sets the device's preferred_local() to the fastest and keeps it for this device and driver. A size
/// must be 5 % faster than 64 to replace it, so that noise decides nothing. Results of kernels do not depend
/// on it.
std::size_t tune_local(Device& device);

/// Sets what tune_local once kept, or tunes now.
std::size_t ensure_tuned(Device& device);

}  // namespace triad
