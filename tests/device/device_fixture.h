#pragma once
/// What device tests share: one open device per process, with the work-group size that is fastest on it,
/// chosen by the environment variable TRIAD_TEST_DEVICE (a --device selector; default: what Triad would
/// choose).
#include <cstdlib>

#include "device/device.h"
#include "kernels/types.h"
#include "trace/tune.h"

namespace triad {

inline Device& test_device() {
    // Never destroyed: some drivers unload themselves before static objects go.
    static Device* const device = [] {
        const char* selector = std::getenv("TRIAD_TEST_DEVICE");
        auto* opened = new Device(Device::open({.selector = selector ? selector : ""}));
        ensure_tuned(*opened);  // 64 is several times slower where the driver vectorises across work-items
        return opened;
    }();
    return *device;
}

/// The same device, as if its largest allocation were of so many bytes.
inline Device limited_device(std::size_t bytes) {
    const char* selector = std::getenv("TRIAD_TEST_DEVICE");
    return Device::open({.selector = selector ? selector : "", .largest_allocation = bytes});
}

/// What the largest allocation of a device must be to render at all: the tables of albedos are one piece.
inline constexpr std::size_t smallest_allocation = sizeof(float) * ALBEDO_FLOATS + 10'000;

}  // namespace triad
