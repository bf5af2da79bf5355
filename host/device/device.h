#pragma once
/// OpenCL behind a wall: this folder alone includes CL/*. A Device is one OpenCL device with an in-order
/// queue.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace triad {

namespace opencl {
struct DeviceState;
struct ProgramState;
struct KernelState;
}  // namespace opencl

/// Work-items of a launch at most, where work can be cut: watchdogs want short launches, and PoCL compiles a
/// kernel a second time for grids beyond 65,535 items. A multiple of the largest work-group.
constexpr std::size_t largest_launch_items = 65472;

struct Recording;  // device/recording.h

/// What `triad devices` shows. Zero is a legal answer for every number.
struct DeviceInfo {
    std::size_t index = 0;  ///< over all platforms; stable while nothing is plugged in or out
    std::string name, vendor, platform, version, c_version, driver;
    std::string type;  ///< "cpu", "gpu", "accelerator", "other"
    std::uint64_t memory = 0, max_allocation = 0, local_memory = 0;
    unsigned compute_units = 0, clock_mhz = 0;
    std::size_t max_work_group = 0;
    std::string hardware;      ///< equal for drivers of one piece of hardware: "cpu", "pci 0000:01:00.0"
    bool host_memory = false;  ///< works in the memory of the host
    bool fp64 = false, images = false, correctly_rounded = false, denormals = false, int64_atomics = false;
    bool usable = false;
    bool preferred = false;             ///< what Triad chooses without --device
    std::string why_unusable;           ///< a sentence; empty when usable
    std::vector<std::string> settings;  ///< of its driver, that make it right: what is set, and why
};

/// A platform that offers nothing, and why; for `triad devices`.
struct PlatformProblem {
    std::string platform, why;
};

struct DeviceList {
    std::vector<DeviceInfo> devices;
    std::vector<PlatformProblem> problems;
};

/// For the first lines of main(): from here on a driver that takes the process down costs no more than a
/// sentence and a new start (docs/decisions/drivers.md). Without it drivers are loaded untried, and what an
/// earlier program found is still believed. Does not return in the child process that tries drivers.
void survive_drivers(int argc, char** argv);

/// Whether a device of this process hangs: ending the process then must wait for nothing (std::_Exit).
bool any_device_hangs();

/// Every device of every platform, in the order of their indices. Never throws for a broken one: it is listed
/// as unusable, or as a problem.
DeviceList list_devices();

/// A file of what is kept about a device with this driver, these settings and the kernels as they are now, in
/// `folder` of the cache folder; empty when nothing can be kept. about: tells several of one device apart.
std::filesystem::path kept_path(const DeviceInfo& device, const std::string& folder,
                                const std::string& about = {});

/// An error of the OpenCL layer: exit code 5 (4 when memory ran out). what() has the call, the code by name
/// and number, device, driver, program, kernel, build options and the whole build log, as far as they apply.
class DeviceError : public Error {
  public:
    DeviceError(Exit exit, int code, const std::string& sentence) : Error(exit, sentence), code_(code) {}
    int code() const { return code_; }

  private:
    int code_;
};

/// Memory on a device. Movable; freed with the last owner.
class Buffer {
  public:
    Buffer() = default;
    std::size_t bytes() const { return bytes_; }
    explicit operator bool() const { return handle_ != nullptr; }

  private:
    friend class Device;
    friend class Arguments;
    std::shared_ptr<void> handle_;
    std::size_t bytes_ = 0;
};

/// A buffer of values of one type.
template <class T>
class DeviceArray : public Buffer {
  public:
    DeviceArray() = default;
    /// Says what the buffer's bytes are.
    explicit DeviceArray(Buffer buffer) : Buffer(std::move(buffer)) {}
};

/// The arguments of a kernel in order; a Buffer that was never allocated is passed as a null pointer.
class Arguments {
  public:
    Arguments& add(const Buffer& buffer);
    template <class T>
    requires(std::is_arithmetic_v<T>) Arguments& add(T value) { return add_bytes(&value, sizeof value); }
    Arguments& add(const Arguments& others);
    Arguments& add_bytes(const void* data, std::size_t size);  ///< of a value; copied

  private:
    friend class Device;
    struct Value {
        std::shared_ptr<void> buffer;
        bool is_buffer;
        std::vector<std::byte> bytes;
    };
    std::vector<Value> values_;  // any buffer stays alive until the launch
};

/// "-D NAME=VALUE" for a program; ordered, so that equal options give equal cache keys.
using Options = std::map<std::string, std::string>;

class Kernel {
  public:
    Kernel() = default;
    const std::string& name() const;

  private:
    friend class Device;
    friend class Program;
    std::shared_ptr<const opencl::KernelState> state_;
};

class Program {
  public:
    /// Throws DeviceError naming the program when it has no such kernel.
    Kernel kernel(const std::string& name) const;

  private:
    friend class Device;
    std::shared_ptr<const opencl::ProgramState> state_;
};

/// What a command of the queue does.
enum class CommandKind { kernel, write, read, fill };

/// A command that has ended, from its profiling event. Nanoseconds on the device's clock, but `enqueued`,
/// which is on the host's steady clock.
struct DeviceCommand {
    CommandKind kind = CommandKind::kernel;
    std::string name;                  ///< of the kernel; else "write", "read", "fill"
    std::size_t items = 0, local = 0;  ///< of a kernel: as many as asked for, and in groups of so many
    std::size_t bytes = 0;             ///< of the others
    std::int64_t enqueued = 0;         ///< by the host
    std::int64_t queued = 0, start = 0, end = 0;
};

/// What a driver tells of a compiled kernel; zeros where it does not.
struct KernelFacts {
    std::string program, name;
    std::size_t private_bytes = 0, local_bytes = 0, max_local = 0, preferred_multiple = 0;
};

/// How long a program took to compile, or to load.
struct Compilation {
    std::string program;
    double seconds = 0;
};

/// Kernel source: the files of kernels/, embedded in the binary, or read from a folder when one is set
/// (--kernels DIR).
namespace kernel_source {
void set_folder(const std::filesystem::path& folder);
/// "traversal/intersect.cl" with its #includes flattened (each file once) and #line marks, so that logs name
/// our files.
std::string load(const std::string& path);
/// The same for a text that is no file of kernels/; `path` is the name that #line gives it.
std::string flatten(const std::string& path, const std::string& text);
/// A driver's log about a flattened text, with our files' names and lines in the place of `<kernel>:LINE`:
/// NVIDIA's compiler heeds no #line.
std::string with_our_lines(const std::string& log, const std::string& flattened);
/// One file as it is.
std::string text(const std::string& path);
/// Every .cl file, by path.
std::vector<std::string> programs();
/// Name of the content of all files; part of cache keys and of a device's verdict.
std::string hash();
}  // namespace kernel_source

class Device {
  public:
    struct Settings {
        std::string selector;  ///< "", index, "cpu"/"gpu", or part of the name or platform (case ignored)
        unsigned threads = 0;  ///< CPU devices: compute units to use (0 = all)
        unsigned part = 0, parts = 1;  ///< CPU devices: the part-th (from 0) of so many equal parts of them
        bool profile = false;          ///< profiling queue; see commands()
        std::size_t largest_allocation = 0;  ///< at most so many bytes in one piece (0: what the device says)
    };

    /// Throws Error(usage) for a selector that matches nothing usable (the sentence lists what there is),
    /// Error(device) when there is no OpenCL device at all.
    static Device open(const Settings& settings);

    const DeviceInfo& info() const;

    /// Uninitialised when `data` is null. Throws DeviceError(memory) that says how much was asked and how
    /// much there is.
    Buffer allocate(std::size_t bytes, const void* data = nullptr);
    template <class T>
    DeviceArray<T> allocate_array(std::size_t size) {
        return DeviceArray<T>(allocate(size * sizeof(T)));
    }
    template <class T>
    DeviceArray<T> upload(std::span<const T> values) {
        return DeviceArray<T>(values.empty() ? Buffer{} : allocate(values.size_bytes(), values.data()));
    }
    template <class T, class Allocator>
    DeviceArray<T> upload(const std::vector<T, Allocator>& values) {
        return upload(std::span<const T>(values));
    }
    /// Values that kernels only read and that `owner` keeps: used where they are by a device that works in
    /// the host's memory, else copied. AlignedVector suits every driver.
    template <class T>
    DeviceArray<T> share(std::span<const T> values, std::shared_ptr<const void> owner) {
        return DeviceArray<T>(values.empty() ? Buffer{}
                                             : share(values.size_bytes(), values.data(), std::move(owner)));
    }
    void write(const Buffer& buffer, const void* data, std::size_t bytes, std::size_t offset = 0);
    void read(const Buffer& buffer, void* data, std::size_t bytes, std::size_t offset = 0);
    template <class T>
    std::vector<T> download(const Buffer& buffer) {
        std::vector<T> values(buffer.bytes() / sizeof(T));
        read(buffer, values.data(), values.size() * sizeof(T));
        return values;
    }
    void fill_zero(const Buffer& buffer);

    /// Compiles `kernels/<path>` with these options and the flags of docs/kernels.md; cached within the
    /// process, and on disk where the driver has no cache of its own. `source` overrides the text (tests).
    Program build(const std::string& path, const Options& options = {});
    Program build_source(const std::string& name, const std::string& source, const Options& options = {});
    /// The same for a text that is flattened already, whatever the device's shape is.
    Program build_flattened(const std::string& name, const std::string& text, const Options& options);

    /// Enqueues `items` work-items, rounded up to a multiple of `local`: kernels guard against the excess. 0
    /// stands for preferred_local(), or less where the kernel allows less; another that it does not allow is
    /// a DeviceError.
    void run(const Kernel& kernel, const Arguments& arguments, std::size_t items, std::size_t local = 0);
    void finish();
    /// How long finish(), read() and write() wait for what was enqueued before: a device that takes longer
    /// hangs, which is a DeviceError, and is used no more. 0, the default: for ever.
    void set_patience(double seconds);

    /// Work-group size for kernels that say none: 64 until another was measured best (trace/tune.h).
    std::size_t preferred_local() const;
    void set_preferred_local(std::size_t local);

    /// What every program on this device is compiled with, unless its own options say otherwise: the shape
    /// that suits it. Empty at first.
    const Options& shape() const;
    void set_shape(Options shape);

    /// What else was chosen for the device, by name: for those who chose. Empty at first.
    std::map<std::string, std::string>& choices();
    const std::map<std::string, std::string>& choices() const;

    /// From here on what the device is told to do (writes, fills, launches) is noted in `recording` too, with
    /// the programs and the memory that this needs; null: no more.
    void record(Recording* recording);
    /// Where the recording has this buffer; none where no command named it.
    std::optional<std::size_t> recorded(const Buffer& buffer) const;

    const std::string& platform_version() const;           ///< of the driver's platform, as it says
    double compile_seconds() const;                        ///< spent in build() so far
    const std::vector<Compilation>& compilations() const;  ///< of build(), in order
    /// All that the queue did so far, in order; empty unless settings.profile. Waits for the queue.
    const std::vector<DeviceCommand>& commands();
    /// Those of them that were not taken before, which are then forgotten: for who looks on for long.
    std::vector<DeviceCommand> take_commands();
    /// Of every kernel that was made so far.
    std::vector<KernelFacts> kernels() const;

  private:
    Buffer share(std::size_t bytes, const void* data, std::shared_ptr<const void> owner);
    /// `is_new`: memory that nobody had before.
    Buffer hold(void* memory, std::size_t bytes, std::shared_ptr<const void> owner, bool is_new);
    explicit Device(std::shared_ptr<opencl::DeviceState> state) : state_(std::move(state)) {}
    std::shared_ptr<opencl::DeviceState> state_;
};

}  // namespace triad
