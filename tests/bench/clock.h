#pragma once
/// What the benchmark measures by: wall time, or the processor time of this process (--clock cpu), which says
/// more on a busy machine and is meaningless where the device is not the host's processor.
#include <chrono>
#include <ctime>

namespace triad::bench {

inline bool use_cpu_clock = false;

/// Seconds since some moment.
inline double now() {
    if (!use_cpu_clock)
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace triad::bench
