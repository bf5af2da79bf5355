#pragma once
/// What a device can do at most, measured on it: the roof of a roofline (Williams, Waterman, Patterson 2009).
#include <cstdint>
#include <vector>

#include "device/device.h"

namespace triad {

/// Of data that lie in `bytes`: a small number is a cache's, a large one the memory's.
struct MemoryPeak {
    std::uint64_t bytes = 0;
    double read = 0, copy = 0;  ///< bytes per second; of a copy both ways together
    double gathers = 0;         ///< per second: reads each of which waits for where the one before points to
};

struct DevicePeaks {
    double flops = 0;                ///< per second: fused multiply-adds of float count as two
    std::vector<MemoryPeak> memory;  ///< by rising bytes
    double seconds = 0;              ///< that measuring took
};

/// The device must have a profiling queue. Takes about two seconds and the compiler's time.
DevicePeaks measure_peaks(Device& device);

/// Measures them, and keeps the best of these and of those that are kept about the device, its compute units
/// and driver: a busy machine makes no roof lower.
DevicePeaks peaks_of(Device& device);

}  // namespace triad
