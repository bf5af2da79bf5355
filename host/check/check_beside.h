#pragma once
/// The check of a device that is new here, beside the first picture on it.
#include <string>

#include "base/child.h"
#include "device/device.h"

namespace triad {

/// A process of its own, `triad check --first`, which keeps its verdict in the cache folder: drivers compile
/// one kernel at a time within a process. Where it fails to, ensure_checked() finds it anew.
class CheckBeside {
  public:
    /// Whether a device without a verdict can get it so: this is a program of ours on more than one
    /// processor, and its cache folder can be written.
    static bool is_due(const Device& device);

    /// Begins, and says so. The device is a whole one that uses every processor; kernels: folder, or empty.
    /// Each of the two processes may take what this one may.
    CheckBeside(const Device& device, const std::string& kernels);

    bool has_ended() { return check_.has_ended(); }
    /// Says what is waited for, where there is something.
    void wait();

  private:
    std::string device_;
    RunningChild check_;
};

}  // namespace triad
