#include <algorithm>
#include <chrono>

#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "device/opencl.h"

namespace fs = std::filesystem;

namespace triad {
namespace opencl {
namespace {

constexpr std::string_view cache_format = "1";

std::string flags(const DeviceInfo& info, const Options& options) {
    std::string text = "-cl-std=CL1.2 -cl-denorms-are-zero";
    if (info.correctly_rounded) text += " -cl-fp32-correctly-rounded-divide-sqrt";
    for (const auto& [name, value] : options) text += " -D " + name + "=" + value;
    return text;
}

std::string build_log(cl_program program, cl_device_id device) {
    std::size_t size = 0;
    if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size) != CL_SUCCESS)
        return {};
    std::string log(size, '\0');
    if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr) != CL_SUCCESS)
        return {};
    log.resize(std::min(log.find('\0'), log.size()));
    return log.substr(0, log.find_last_not_of(" \n") + 1);
}

/// Where the driver's binary of a program lies; empty when there is no cache.
fs::path cache_path(const DeviceState& state, const std::string& text, const std::string& options) {
    const fs::path folder = state.disk_cache ? cache_folder() : fs::path{};
    if (folder.empty()) return {};
    const DeviceInfo& info = state.core->info;
    Hash key;
    for (std::string_view part :
         {cache_format, std::string_view(info.platform), std::string_view(state.platform_version),
          std::string_view(info.name), std::string_view(info.driver), std::string_view(options),
          std::string_view(text)})
        key.add(part);
    for (const std::string& setting : info.settings) key.add(setting);  // it decides what a driver makes
    return folder / "programs" / (key.hex() + ".bin");
}

/// A binary is stored behind its hash: drivers crash on damaged ones. Null when there is none or it does not
/// build.
std::shared_ptr<void> load_binary(const DeviceState& state, const fs::path& path,
                                  const std::string& options) {
    std::error_code absent;
    if (path.empty() || !fs::exists(path, absent)) return {};
    try {
        const std::vector<std::uint8_t> file = read_file(path, 1u << 30);
        const std::size_t digits = Hash().hex().size();
        if (file.size() <= digits) return {};
        const unsigned char* binary = file.data() + digits;
        const std::size_t size = file.size() - digits;
        if (Hash().add(binary, size).hex() !=
            std::string(file.begin(), file.begin() + static_cast<long>(digits)))
            return {};
        const Peril peril(compiling_note(state.core->info, "loaded a compiled program"));
        cl_int code = CL_SUCCESS, status = CL_SUCCESS;
        cl_program program =
            clCreateProgramWithBinary(state.cl(), 1, &state.device, &size, &binary, &status, &code);
        if (code != CL_SUCCESS) return {};
        auto owned = own(program, clReleaseProgram, state.core);
        if (status != CL_SUCCESS ||
            clBuildProgram(program, 1, &state.device, options.c_str(), nullptr, nullptr) != CL_SUCCESS)
            return {};
        return owned;
    } catch (const Error& error) {
        detail(std::string("Program cache: ") + error.what());
        return {};
    }
}

void store_binary(cl_program program, const fs::path& path) {
    if (path.empty()) return;
    std::size_t size = 0;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr) != CL_SUCCESS ||
        size == 0)
        return;
    std::string binary(size, '\0');
    auto* data = reinterpret_cast<unsigned char*>(binary.data());
    if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof data, &data, nullptr) != CL_SUCCESS) return;
    try {
        fs::create_directories(path.parent_path());
        write_file(path, Hash().add(binary.data(), binary.size()).hex() + binary);
    } catch (const std::exception& error) {
        warn(std::string("Compiled kernels are not kept: ") + error.what());
    }
}

std::shared_ptr<void> compile(const DeviceState& state, const std::string& text, const Where& names) {
    Core& core = *state.core;
    const Peril peril(compiling_note(core.info, "compiled " + names.program));
    const char* source = text.c_str();
    cl_int code = CL_SUCCESS;
    cl_program program = clCreateProgramWithSource(state.cl(), 1, &source, nullptr, &code);
    core.check("clCreateProgramWithSource", code, names);
    auto owned = own(program, clReleaseProgram, state.core);
    code = clBuildProgram(program, 1, &state.device, names.options.c_str(), nullptr, nullptr);
    if (code != CL_SUCCESS && is_pocl(core.info.platform) && is_pocl_cache_full()) peril.die("a full disk");
    Where where = names;
    where.log = kernel_source::with_our_lines(build_log(program, state.device), text);
    if (code != CL_SUCCESS) where.sentence = "The driver cannot compile " + names.program + ".";
    core.check("clBuildProgram", code, where);
    // PoCL reads an emptied file of its cache as a program without kernels.
    std::size_t kernels = 1;
    clGetProgramInfo(program, CL_PROGRAM_NUM_KERNELS, sizeof kernels, &kernels, nullptr);
    if (kernels == 0 && is_pocl(core.info.platform)) peril.die("a program without kernels");
    if (!where.log.empty()) detail("Build log of " + names.program + ":\n" + where.log);
    return owned;
}

}  // namespace
}  // namespace opencl

Program Device::build(const std::string& path, const Options& options) {
    return build_source(path, kernel_source::text(path), options);
}

Program Device::build_source(const std::string& name, const std::string& source, const Options& options) {
    Options all = options;
    all.insert(state_->shape.begin(), state_->shape.end());
    return build_flattened(name, kernel_source::flatten(name, source), all);
}

Program Device::build_flattened(const std::string& name, const std::string& text, const Options& options) {
    opencl::DeviceState& device = *state_;
    device.core->require_alive();
    const std::string flags = opencl::flags(device.core->info, options);
    Program& program = device.programs[{text, flags}];
    if (program.state_) return program;
    const auto start = std::chrono::steady_clock::now();
    auto state = std::make_shared<opencl::ProgramState>();
    state->core = device.core;
    state->path = name;
    state->options = flags;
    state->text = text;
    state->definitions = options;
    const fs::path cached = opencl::cache_path(device, text, flags);
    state->handle = opencl::load_binary(device, cached, flags);
    if (!state->handle) {
        state->handle = opencl::compile(device, text, {.program = name, .options = flags});
        opencl::store_binary(static_cast<cl_program>(state->handle.get()), cached);
    }
    program.state_ = std::move(state);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    device.compile_seconds += seconds;
    device.compilations.push_back({name, seconds});
    return program;
}

Kernel Program::kernel(const std::string& name) const {
    const opencl::ProgramState& program = *state_;
    opencl::Core& core = *program.core;
    core.require_alive();
    auto state = std::make_shared<opencl::KernelState>();
    state->program = state_;
    state->where = {.program = program.path, .kernel = name, .options = program.options};
    cl_int code = CL_SUCCESS;
    cl_kernel handle = clCreateKernel(static_cast<cl_program>(program.handle.get()), name.c_str(), &code);
    opencl::Where where = state->where;
    if (code == CL_INVALID_KERNEL_NAME)
        where.sentence = "Program " + program.path + " has no kernel " + name + ".";
    core.check("clCreateKernel", code, where);
    state->handle = opencl::own(handle, clReleaseKernel, program.core);
    core.check("clGetKernelInfo",
               clGetKernelInfo(handle, CL_KERNEL_NUM_ARGS, sizeof state->argument_count,
                               &state->argument_count, nullptr),
               state->where);
    // Null: the context has one device. A failure leaves 0, and run() uses the device's own limit.
    clGetKernelWorkGroupInfo(handle, nullptr, CL_KERNEL_WORK_GROUP_SIZE, sizeof state->max_local,
                             &state->max_local, nullptr);
    Kernel kernel;
    kernel.state_ = std::move(state);
    return kernel;
}

const std::string& Kernel::name() const {
    static const std::string none;
    return state_ ? state_->where.kernel : none;
}

}  // namespace triad
