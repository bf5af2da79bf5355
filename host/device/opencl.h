#pragma once
/// Inside of the wall: what the files of this folder share. OpenCL 1.2 is all that is used: every driver has
/// it, and clCreateCommandQueueWithProperties of 2.0 hangs on a 1.2 device under some loaders.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <atomic>
#include <set>

#include "device/device.h"
#include "device/drivers.h"

namespace triad::opencl {

/// One device as the drivers list it.
struct Found {
    cl_platform_id platform = nullptr;
    cl_device_id device = nullptr;
    DeviceInfo info;
    bool left_out = false;  ///< its driver died
};

/// All devices of all platforms as the loaded drivers describe them; `problems` receives the platforms
/// without any.
std::vector<Found> ask_drivers(std::vector<PlatformProblem>& problems);

/// The same, when drivers that die have been dealt with, with `preferred` set on at most one.
std::vector<Found> find_devices(std::vector<PlatformProblem>& problems);

/// The usable device that Settings::selector means. Throws as Device::open says.
Found choose(const std::string& selector);

/// A text property of a platform; empty when it cannot be had.
std::string platform_text(cl_platform_id platform, cl_platform_info what);

/// "CL_OUT_OF_RESOURCES (-5)"
std::string error_name(cl_int code);

/// "1.50 GiB"
std::string readable_bytes(std::uint64_t bytes);

/// What an error message says beside the call, the code and the device; empty parts are left out.
struct Where {
    std::string sentence;  ///< for people, before the technical part
    std::string program, kernel, options, log;
};

/// What every handle of one open device shares; outlives the Device in the handles that it gave away.
struct Core {
    DeviceInfo info;
    std::atomic<bool> lost = false;  ///< a fatal error happened: the driver is not called again, it may hang
    std::atomic<std::uint64_t> allocated = 0;

    /// Throws DeviceError unless code is CL_SUCCESS; Exit::memory for the codes that mean it. Notes a fatal
    /// code.
    void check(const char* call, cl_int code, const Where& where = {});
    /// Throws DeviceError when an earlier error was fatal.
    void require_alive() const;
};

/// One reference to an OpenCL object, released with the last owner unless the device was lost.
template <class Handle>
std::shared_ptr<void> own(Handle handle, cl_int (*release)(Handle), std::shared_ptr<Core> core) {
    return {handle, [release, core = std::move(core)](void* object) {
                if (!core->lost) release(static_cast<Handle>(object));
            }};
}

struct ProgramState {
    std::shared_ptr<Core> core;
    std::shared_ptr<void> handle;
    std::string path, options, text;
    Options definitions;  ///< those of `options` that are not the driver's
};

struct KernelState {
    std::shared_ptr<const ProgramState> program;
    std::shared_ptr<void> handle;
    Where where;
    cl_uint argument_count = 0;
    std::size_t max_local = 0;  ///< 0: the driver did not say
};

class Recorder;

struct DeviceState {
    DeviceState();
    ~DeviceState();
    std::shared_ptr<Core> core = std::make_shared<Core>();
    std::string platform_version;
    bool profile = false;
    bool disk_cache = false;
    cl_device_id device = nullptr;
    std::shared_ptr<void> partition, context,
        queue;  ///< in the order of creation: destruction goes backwards
    std::map<std::pair<std::string, std::string>, Program> programs;      ///< by text and options
    std::vector<std::pair<DeviceCommand, std::shared_ptr<void>>> events;  ///< not yet among `ended`
    std::vector<DeviceCommand> ended;
    std::vector<Compilation> compilations;
    std::set<std::pair<std::string, std::size_t>> ran;  ///< kernels by name and work-group size
    std::optional<Peril> first_runs;                    ///< of kernels, until they have ended
    std::size_t preferred_local = 1;
    Options shape;
    std::map<std::string, std::string> choices;
    double compile_seconds = 0, patience = 0;
    std::unique_ptr<Recorder> recorder;  ///< null: nothing is recorded

    cl_context cl() const { return static_cast<cl_context>(context.get()); }
    cl_command_queue commands() const { return static_cast<cl_command_queue>(queue.get()); }
    /// Waits for the queue and moves its commands from `events` to `ended`.
    void finish();
    /// Where a command's event goes: null unless the queue is profiled.
    cl_event* event_for(cl_event& event) const { return profile ? &event : nullptr; }
    /// A command that was just enqueued; nothing without an event.
    void note(cl_event event, DeviceCommand command);
    /// Waits until the queue is empty, with patience.
    void await();
};

}  // namespace triad::opencl
