// What the queue did and when, and what drivers tell of kernels.
#include <algorithm>
#include <chrono>
#include <utility>

#include "device/opencl.h"

namespace triad {
namespace opencl {

void DeviceState::note(cl_event event, DeviceCommand command) {
    if (!event) return;
    command.enqueued = std::chrono::duration_cast<std::chrono::nanoseconds>(
                           std::chrono::steady_clock::now().time_since_epoch())
                           .count();
    events.emplace_back(std::move(command), own(event, clReleaseEvent, core));
}

void DeviceState::finish() {
    core->require_alive();
    await();
    core->check("clFinish", clFinish(commands()));
    first_runs.reset();
    for (auto& [command, handle] : events) {
        const auto event = static_cast<cl_event>(handle.get());
        for (const auto& [what, time] : {std::pair(CL_PROFILING_COMMAND_QUEUED, &command.queued),
                                         {CL_PROFILING_COMMAND_START, &command.start},
                                         {CL_PROFILING_COMMAND_END, &command.end}}) {
            cl_ulong nanoseconds = 0;
            core->check("clGetEventProfilingInfo",
                        clGetEventProfilingInfo(event, what, sizeof nanoseconds, &nanoseconds, nullptr),
                        {.kernel = command.name});
            *time = std::int64_t(nanoseconds);
        }
        ended.push_back(std::move(command));
    }
    events.clear();
}

namespace {

std::size_t fact_of(cl_kernel kernel, cl_device_id device, cl_kernel_work_group_info what) {
    cl_ulong value = 0;  // size_t or cl_ulong
    std::size_t size = 0;
    if (clGetKernelWorkGroupInfo(kernel, device, what, sizeof value, &value, &size) != CL_SUCCESS) return 0;
    return std::size_t(value);
}

}  // namespace
}  // namespace opencl

const std::vector<DeviceCommand>& Device::commands() {
    if (state_->profile) state_->finish();
    return state_->ended;
}

std::vector<DeviceCommand> Device::take_commands() {
    commands();
    return std::exchange(state_->ended, {});
}

const std::vector<Compilation>& Device::compilations() const { return state_->compilations; }

std::vector<KernelFacts> Device::kernels() const {
    std::vector<KernelFacts> all;
    for (const auto& [key, program] : state_->programs) {
        const auto handle = static_cast<cl_program>(program.state_->handle.get());
        cl_uint count = 0;
        if (clCreateKernelsInProgram(handle, 0, nullptr, &count) != CL_SUCCESS) continue;
        std::vector<cl_kernel> kernels(count);
        if (clCreateKernelsInProgram(handle, count, kernels.data(), nullptr) != CL_SUCCESS) continue;
        for (const cl_kernel kernel : kernels) {
            const auto owned = opencl::own(kernel, clReleaseKernel, state_->core);
            std::string name(256, '\0');
            std::size_t size = 0;
            if (clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, name.size(), name.data(), &size) !=
                CL_SUCCESS)
                continue;
            name.resize(std::min(name.find('\0'), name.size()));
            const auto fact = [&](cl_kernel_work_group_info what) {
                return opencl::fact_of(kernel, state_->device, what);
            };
            all.push_back({program.state_->path, name, fact(CL_KERNEL_PRIVATE_MEM_SIZE),
                           fact(CL_KERNEL_LOCAL_MEM_SIZE), fact(CL_KERNEL_WORK_GROUP_SIZE),
                           fact(CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE)});
        }
    }
    return all;
}

}  // namespace triad
