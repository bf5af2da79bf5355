#pragma once
/// Inside of the wall: notes what a device is told to do (Device::record).
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/opencl.h"
#include "device/recording.h"

namespace triad::opencl {

/// Is told of every command before it is enqueued: memory that it meets for the first time has the bytes
/// that it had when recording began, and these are read.
class Recorder {
  public:
    Recorder(DeviceState& state, Recording& to) : state_(state), to_(to) {}

    using Handle = std::shared_ptr<void>;
    void write(const Handle& memory, const void* data, std::size_t bytes, std::size_t offset);
    void fill_zero(const Handle& memory);
    Recording::Argument argument(const Handle& memory);  ///< which may be null
    static Recording::Argument argument(const std::vector<std::byte>& value);
    void launch(const KernelState& kernel, const std::vector<Recording::Argument>& arguments,
                std::size_t items, std::size_t local);

    /// Its place among the memories; `overwritten`: what it held does not matter.
    std::size_t place_of(const Handle& memory, bool overwritten = false);
    /// None: no command named it.
    std::optional<std::size_t> known_place_of(const Handle& memory) const;

  private:
    DeviceState& state_;
    Recording& to_;
    std::map<void*, std::size_t> memories_;
    std::vector<Handle> kept_;  ///< so that no other memory gets the handle of one that was met
    std::map<const ProgramState*, std::size_t> sources_;
    std::map<std::pair<std::size_t, std::string>, std::size_t> functions_;
    std::map<std::string, std::size_t> argument_lists_;  ///< by what they hold, as text

    std::size_t function_of(const KernelState& kernel);
};

}  // namespace triad::opencl
