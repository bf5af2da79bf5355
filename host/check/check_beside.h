#pragma once
/// The check of a device that is new here, beside the first picture on it.
#include <future>
#include <string>

#include "device/device.h"

namespace triad {

/// Whether a device can be checked in another process: this is a program of ours, and the verdict can be
/// kept.
bool can_check_beside(const Device& device);

/// A process of its own, `triad check --first`, which leaves its verdict in the cache folder: drivers compile
/// one kernel at a time within a process. Where it fails to, ensure_checked() finds the verdict anew.
class CheckBeside {
  public:
    /// Begins. `selector`, `threads`: what the device was opened by; `kernels`: folder, or empty.
    CheckBeside(const Device& device, const std::string& selector, unsigned threads,
                const std::string& kernels);

    bool has_ended() const;
    void wait() const { ended_.wait(); }

  private:
    std::future<void> ended_;
};

}  // namespace triad
