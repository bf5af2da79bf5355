#pragma once
/// The work of a capture, done again on a device.
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "device/device.h"

namespace triad {

/// Work-group sizes of kernels by name, for launches that name none.
using LocalSizes = std::map<std::string, std::size_t>;

/// The arrays of a capture's film, in its order.
using ReplayedFilm = std::vector<AlignedVector<std::byte>>;

/// What a run took: by the host's clock, and command by command.
struct ReplayedRun {
    double seconds = 0;
    std::vector<DeviceCommand> commands;
};

class Replayer {
  public:
    /// Compiles the programs and allocates the buffers. Both must live as long. Throws DeviceError.
    Replayer(Device& device, const Capture& capture);

    /// Everything from the beginning, to its end.
    ReplayedRun run(const LocalSizes& sizes = {});
    /// What the buffers of the film hold.
    ReplayedFilm film();

    /// Places of the launches of a kernel among the commands; empty: there is none of that name.
    std::vector<std::size_t> launches_of(const std::string& kernel) const;
    /// Everything up to command `place`, a launch, and then it alone so many times, each time with the
    /// buffers as they were before it: a run each.
    std::vector<ReplayedRun> repeat(std::size_t place, unsigned times);

    const std::string& kernel_of(const Recording::Launch& launch) const {
        return capture_.work.functions[launch.function].name;
    }
    const Capture& capture() const { return capture_; }
    Device& device() const { return device_; }

  private:
    Device& device_;
    const Capture& capture_;
    std::size_t local_;  ///< where no size is asked for
    std::vector<Buffer> buffers_;
    std::vector<Kernel> kernels_;
    std::vector<Arguments> arguments_;

    void restore();
    void enqueue(const Recording::Command& command, const LocalSizes& sizes);
    /// Of what `enqueue` enqueues.
    ReplayedRun timed(const std::function<void()>& enqueue);
};

}  // namespace triad
