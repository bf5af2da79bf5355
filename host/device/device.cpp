#include "device/device.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "base/memory_limit.h"
#include "device/opencl.h"
#include "device/recorder.h"

namespace triad {

using opencl::own;
using opencl::readable_bytes;
using opencl::Where;

namespace {
constexpr std::size_t default_local = 64;
}

namespace opencl {
namespace {

/// The device, or the part of a CPU device that the settings ask for. Sets info.compute_units to what is
/// used.
cl_device_id restrict_to(const Device::Settings& settings, DeviceState& state) {
    DeviceInfo& info = state.core->info;
    const bool is_cpu = info.type == "cpu";
    const unsigned all = info.compute_units,
                   units = is_cpu && settings.threads > 0 ? std::min(settings.threads, all) : all;
    if (settings.parts > 1 && (!is_cpu || settings.parts > units))
        throw Error(
            Exit::usage,
            info.name + " cannot be taken in " + std::to_string(settings.parts) + " parts: " +
                (is_cpu ? "it has " + std::to_string(units) + " compute units." : "only CPU devices can."));
    if (units == all && settings.parts <= 1) return state.device;
    std::vector<cl_device_partition_property> counts{CL_DEVICE_PARTITION_BY_COUNTS};
    const auto end_of = [&](unsigned part) { return units * part / settings.parts; };
    for (unsigned part = 0; part < settings.parts; ++part)
        counts.push_back(static_cast<cl_device_partition_property>(end_of(part + 1) - end_of(part)));
    counts.push_back(CL_DEVICE_PARTITION_BY_COUNTS_LIST_END), counts.push_back(0);
    std::vector<cl_device_id> parts(settings.parts);
    const Where where{.sentence = "The driver cannot be held to a part of its device; leave " +
                                  std::string(settings.parts > 1 ? "/N" : "--threads") + " out."};
    state.core->check("clCreateSubDevices",
                      clCreateSubDevices(state.device, counts.data(), settings.parts, parts.data(), nullptr),
                      where);
    // Never released: PoCL 3.1 uses it in its own threads after the last queue, context and event are gone.
    info.compute_units = end_of(settings.part + 1) - end_of(settings.part);
    return parts[settings.part];
}

}  // namespace

DeviceState::DeviceState() = default;
DeviceState::~DeviceState() = default;

}  // namespace opencl

Device Device::open(const Settings& settings) {
    const opencl::Found found = opencl::choose(settings.selector);
    auto state = std::make_shared<opencl::DeviceState>();
    opencl::Core& core = *state->core;
    core.info = found.info;
    if (settings.largest_allocation > 0) core.info.max_allocation = settings.largest_allocation;
    state->profile = settings.profile;
    state->platform_version = opencl::platform_text(found.platform, CL_PLATFORM_VERSION);
    // PoCL keeps compiled kernels itself, and asking it for binaries compiles everything a second time.
    state->disk_cache = !opencl::is_pocl(found.info.platform);
    state->device = found.device;
    state->device = opencl::restrict_to(settings, *state);

    const Peril peril(opencl::compiling_note(found.info, "opened the device"));
    cl_int code = CL_SUCCESS;
    const cl_context_properties on[] = {CL_CONTEXT_PLATFORM,
                                        reinterpret_cast<cl_context_properties>(found.platform), 0};
    cl_context context = clCreateContext(on, 1, &state->device, nullptr, nullptr, &code);
    core.check("clCreateContext", code);
    state->context = own(context, clReleaseContext, state->core);
    cl_command_queue queue =
        clCreateCommandQueue(context, state->device, settings.profile ? CL_QUEUE_PROFILING_ENABLE : 0, &code);
    core.check("clCreateCommandQueue", code);
    state->queue = own(queue, clReleaseCommandQueue, state->core);

    Device device(std::move(state));
    device.set_preferred_local(default_local);
    return device;
}

const DeviceInfo& Device::info() const { return state_->core->info; }

namespace opencl {
namespace {

cl_mem create_buffer(DeviceState& state, std::size_t bytes, cl_mem_flags flags, const void* data) {
    Core& core = *state.core;
    core.require_alive();
    const DeviceInfo& info = core.info;
    const Where where{.sentence =
                          "Out of device memory: " + readable_bytes(bytes) +
                          " were asked for in one piece; the largest piece is " +
                          readable_bytes(info.max_allocation) + ", and " + readable_bytes(core.allocated) +
                          " of " + readable_bytes(info.memory) +
                          " are in use by this process. Use a smaller picture or scene, or another device."};
    // Drivers need not refuse more than the largest piece, so ask no driver.
    if (info.max_allocation > 0 && bytes > info.max_allocation)
        core.check("clCreateBuffer", CL_INVALID_BUFFER_SIZE, where);
    const bool is_new = !(flags & CL_MEM_USE_HOST_PTR);
    if (is_new) require_memory(bytes, "A buffer of the device " + info.name);
    cl_int code = CL_SUCCESS;
    const cl_mem memory = clCreateBuffer(state.cl(), flags, bytes, const_cast<void*>(data), &code);
    core.check("clCreateBuffer", code, where);
    core.allocated += bytes;
    if (is_new) count_memory(std::int64_t(bytes));
    return memory;
}

}  // namespace
}  // namespace opencl

Buffer Device::allocate(std::size_t bytes, const void* data) {
    if (bytes == 0) return {};
    const cl_mem memory =
        opencl::create_buffer(*state_, bytes, CL_MEM_READ_WRITE | (data ? CL_MEM_COPY_HOST_PTR : 0), data);
    return hold(memory, bytes, {}, true);
}

Buffer Device::share(std::size_t bytes, const void* data, std::shared_ptr<const void> owner) {
    const bool in_place = info().host_memory;
    const cl_mem memory = opencl::create_buffer(
        *state_, bytes, CL_MEM_READ_ONLY | (in_place ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR), data);
    return hold(memory, bytes, in_place ? std::move(owner) : nullptr, !in_place);
}

Buffer Device::hold(void* memory, std::size_t bytes, std::shared_ptr<const void> owner, bool is_new) {
    Buffer buffer;
    buffer.bytes_ = bytes;
    buffer.handle_ = {memory, [core = state_->core, bytes, is_new, owner = std::move(owner)](void* object) {
                          core->allocated -= bytes;
                          if (is_new) count_memory(-std::int64_t(bytes));
                          if (!core->lost)
                              clReleaseMemObject(static_cast<cl_mem>(object));
                          else  // a kernel that hangs may still read it: never freed
                              new std::shared_ptr<const void>(owner);
                      }};
    return buffer;
}

void Device::write(const Buffer& buffer, const void* data, std::size_t bytes, std::size_t offset) {
    if (bytes == 0) return;
    state_->core->require_alive();
    state_->await();
    if (state_->recorder) state_->recorder->write(buffer.handle_, data, bytes, offset);
    cl_event event = nullptr;
    state_->core->check(
        "clEnqueueWriteBuffer",
        clEnqueueWriteBuffer(state_->commands(), static_cast<cl_mem>(buffer.handle_.get()), CL_TRUE, offset,
                             bytes, data, 0, nullptr, state_->event_for(event)));
    state_->note(event, {.kind = CommandKind::write, .name = "write", .bytes = bytes});
}

void Device::read(const Buffer& buffer, void* data, std::size_t bytes, std::size_t offset) {
    if (bytes == 0) return;
    state_->core->require_alive();
    state_->await();
    cl_event event = nullptr;
    state_->core->check(
        "clEnqueueReadBuffer",
        clEnqueueReadBuffer(state_->commands(), static_cast<cl_mem>(buffer.handle_.get()), CL_TRUE, offset,
                            bytes, data, 0, nullptr, state_->event_for(event)));
    state_->note(event, {.kind = CommandKind::read, .name = "read", .bytes = bytes});
    state_->first_runs.reset();
}

void Device::fill_zero(const Buffer& buffer) {
    if (!buffer) return;
    state_->core->require_alive();
    if (state_->recorder) state_->recorder->fill_zero(buffer.handle_);
    const cl_uchar zero = 0;
    cl_event event = nullptr;
    state_->core->check(
        "clEnqueueFillBuffer",
        clEnqueueFillBuffer(state_->commands(), static_cast<cl_mem>(buffer.handle_.get()), &zero, sizeof zero,
                            0, buffer.bytes(), 0, nullptr, state_->event_for(event)));
    state_->note(event, {.kind = CommandKind::fill, .name = "fill", .bytes = buffer.bytes()});
}

void Device::run(const Kernel& kernel, const Arguments& arguments, std::size_t items, std::size_t local) {
    if (items == 0) return;
    opencl::Core& core = *state_->core;
    core.require_alive();
    const opencl::KernelState& state = *kernel.state_;
    const auto handle = static_cast<cl_kernel>(state.handle.get());
    // A kernel keeps the arguments of its last launch, which would hide that one is missing now.
    if (arguments.values_.size() != state.argument_count) {
        Where where = state.where;
        where.sentence = "Kernel " + kernel.name() + " takes " + std::to_string(state.argument_count) +
                         " arguments, not " + std::to_string(arguments.values_.size()) + ".";
        core.check("clSetKernelArg", CL_INVALID_KERNEL_ARGS, where);
    }
    for (cl_uint i = 0; i < state.argument_count; ++i) {
        const Arguments::Value& value = arguments.values_[i];
        void* const memory = value.buffer.get();
        const cl_int code = value.is_buffer
                                ? clSetKernelArg(handle, i, sizeof(cl_mem), memory ? &memory : nullptr)
                                : clSetKernelArg(handle, i, value.bytes.size(), value.bytes.data());
        if (code == CL_SUCCESS) continue;
        Where where = state.where;
        where.sentence = "Argument " + std::to_string(i) + " of kernel " + kernel.name() + " does not fit.";
        core.check("clSetKernelArg", code, where);
    }
    if (state_->recorder) {
        std::vector<Recording::Argument> noted;
        for (const Arguments::Value& value : arguments.values_)
            noted.push_back(value.is_buffer ? state_->recorder->argument(value.buffer)
                                            : opencl::Recorder::argument(value.bytes));
        state_->recorder->launch(state, noted, items, local);
    }
    if (local == 0) {
        local = preferred_local();
        if (state.max_local > 0) local = std::min(local, state.max_local);
    }
    // Some drivers answer a group that is too large as they answer a crash.
    if (state.max_local > 0 && local > state.max_local) {
        Where where = state.where;
        where.sentence = "Kernel " + kernel.name() + " runs in groups of at most " +
                         std::to_string(state.max_local) + " on this device, not " + std::to_string(local) +
                         ".";
        core.check("clEnqueueNDRangeKernel", CL_INVALID_WORK_GROUP_SIZE, where);
    }
    if (restarts_allowed() && state_->ran.emplace(state.where.program + " " + kernel.name(), local).second)
        if (!state_->first_runs)
            state_->first_runs.emplace(opencl::running_note(info(), kernel.name()), Peril::Of::kernels);
    const std::size_t global = (items + local - 1) / local * local;
    cl_event event = nullptr;
    core.check("clEnqueueNDRangeKernel",
               clEnqueueNDRangeKernel(state_->commands(), handle, 1, nullptr, &global, &local, 0, nullptr,
                                      state_->event_for(event)),
               state.where);
    state_->note(event, {.kind = CommandKind::kernel, .name = kernel.name(), .items = items, .local = local});
}

void Device::finish() { state_->finish(); }

void Device::set_patience(double seconds) { state_->patience = seconds; }

std::size_t Device::preferred_local() const { return state_->preferred_local; }

void Device::set_preferred_local(std::size_t local) {
    const std::size_t most = info().max_work_group;
    state_->preferred_local = std::max<std::size_t>(1, most > 0 ? std::min(local, most) : local);
}

const Options& Device::shape() const { return state_->shape; }
std::map<std::string, std::string>& Device::choices() { return state_->choices; }
const std::map<std::string, std::string>& Device::choices() const { return state_->choices; }
void Device::set_shape(Options shape) { state_->shape = std::move(shape); }

const std::string& Device::platform_version() const { return state_->platform_version; }

double Device::compile_seconds() const { return state_->compile_seconds; }

Arguments& Arguments::add(const Buffer& buffer) {
    values_.push_back({buffer.handle_, true, {}});
    return *this;
}

Arguments& Arguments::add(const Arguments& others) {
    values_.insert(values_.end(), others.values_.begin(), others.values_.end());
    return *this;
}

Arguments& Arguments::add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    values_.push_back({nullptr, false, {bytes, bytes + size}});
    return *this;
}

}  // namespace triad
