#pragma once
/// What pilots chose, kept in the cache folder: their choice follows from scene, view and size alone, so that
/// a picture which is rendered again need not be flown again.
#include <cstdint>
#include <optional>
#include <string>

#include "device/device.h"

namespace triad {

struct PilotChoice {
    bool paths;             ///< alone
    std::uint64_t photons;  ///< with every sample; 0: paths alone
};

/// `about`: all that the choice follows from. None where it was not kept, or by another build of this
/// program.
std::optional<PilotChoice> kept_pilot(const DeviceInfo& device, const std::string& about);

/// Never throws: what cannot be kept is flown again.
void keep_pilot(const DeviceInfo& device, const std::string& about, const PilotChoice& choice);

}  // namespace triad
