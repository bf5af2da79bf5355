#pragma once
/// What device tests share: one open device per process, chosen by the environment variable TRIAD_TEST_DEVICE
/// (a
/// --device selector; default: what Triad would choose).
#include <cstdlib>

#include "device/device.h"

namespace triad {

inline Device& test_device() {
    // Never destroyed: some drivers unload themselves before static objects go.
    static Device* const device = [] {
        const char* selector = std::getenv("TRIAD_TEST_DEVICE");
        return new Device(Device::open({.selector = selector ? selector : ""}));
    }();
    return *device;
}

}  // namespace triad
