#include <array>
#include <cstdio>

#include "device/opencl.h"

namespace triad::opencl {
namespace {

/// Codes 0 to -19 and -30 to -68 of OpenCL 1.2; the gap is reserved.
constexpr std::array run_time{"CL_SUCCESS",
                              "CL_DEVICE_NOT_FOUND",
                              "CL_DEVICE_NOT_AVAILABLE",
                              "CL_COMPILER_NOT_AVAILABLE",
                              "CL_MEM_OBJECT_ALLOCATION_FAILURE",
                              "CL_OUT_OF_RESOURCES",
                              "CL_OUT_OF_HOST_MEMORY",
                              "CL_PROFILING_INFO_NOT_AVAILABLE",
                              "CL_MEM_COPY_OVERLAP",
                              "CL_IMAGE_FORMAT_MISMATCH",
                              "CL_IMAGE_FORMAT_NOT_SUPPORTED",
                              "CL_BUILD_PROGRAM_FAILURE",
                              "CL_MAP_FAILURE",
                              "CL_MISALIGNED_SUB_BUFFER_OFFSET",
                              "CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST",
                              "CL_COMPILE_PROGRAM_FAILURE",
                              "CL_LINKER_NOT_AVAILABLE",
                              "CL_LINK_PROGRAM_FAILURE",
                              "CL_DEVICE_PARTITION_FAILED",
                              "CL_KERNEL_ARG_INFO_NOT_AVAILABLE"};
constexpr std::array use{"CL_INVALID_VALUE",
                         "CL_INVALID_DEVICE_TYPE",
                         "CL_INVALID_PLATFORM",
                         "CL_INVALID_DEVICE",
                         "CL_INVALID_CONTEXT",
                         "CL_INVALID_QUEUE_PROPERTIES",
                         "CL_INVALID_COMMAND_QUEUE",
                         "CL_INVALID_HOST_PTR",
                         "CL_INVALID_MEM_OBJECT",
                         "CL_INVALID_IMAGE_FORMAT_DESCRIPTOR",
                         "CL_INVALID_IMAGE_SIZE",
                         "CL_INVALID_SAMPLER",
                         "CL_INVALID_BINARY",
                         "CL_INVALID_BUILD_OPTIONS",
                         "CL_INVALID_PROGRAM",
                         "CL_INVALID_PROGRAM_EXECUTABLE",
                         "CL_INVALID_KERNEL_NAME",
                         "CL_INVALID_KERNEL_DEFINITION",
                         "CL_INVALID_KERNEL",
                         "CL_INVALID_ARG_INDEX",
                         "CL_INVALID_ARG_VALUE",
                         "CL_INVALID_ARG_SIZE",
                         "CL_INVALID_KERNEL_ARGS",
                         "CL_INVALID_WORK_DIMENSION",
                         "CL_INVALID_WORK_GROUP_SIZE",
                         "CL_INVALID_WORK_ITEM_SIZE",
                         "CL_INVALID_GLOBAL_OFFSET",
                         "CL_INVALID_EVENT_WAIT_LIST",
                         "CL_INVALID_EVENT",
                         "CL_INVALID_OPERATION",
                         "CL_INVALID_GL_OBJECT",
                         "CL_INVALID_BUFFER_SIZE",
                         "CL_INVALID_MIP_LEVEL",
                         "CL_INVALID_GLOBAL_WORK_SIZE",
                         "CL_INVALID_PROPERTY",
                         "CL_INVALID_IMAGE_DESCRIPTOR",
                         "CL_INVALID_COMPILER_OPTIONS",
                         "CL_INVALID_LINKER_OPTIONS",
                         "CL_INVALID_DEVICE_PARTITION_COUNT"};
static_assert(-CL_KERNEL_ARG_INFO_NOT_AVAILABLE + 1 == run_time.size());
static_assert(-CL_INVALID_DEVICE_PARTITION_COUNT - 30 + 1 == use.size());

bool means_memory(cl_int code) {
    return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY ||
           code == CL_INVALID_BUFFER_SIZE;
}

/// After these the next call may hang or answer nonsense. Vendors' own codes (below -68) are driver faults.
bool means_lost(cl_int code) {
    return code == CL_OUT_OF_RESOURCES || code == CL_DEVICE_NOT_AVAILABLE ||
           code == CL_INVALID_COMMAND_QUEUE || code == CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST ||
           code < CL_INVALID_DEVICE_PARTITION_COUNT;
}

}  // namespace

std::string error_name(cl_int code) {
    const std::size_t up = code <= 0 ? static_cast<std::size_t>(-static_cast<long>(code)) : ~std::size_t(0);
    std::string name = "an error of the driver's own";
    if (up < run_time.size()) name = run_time[up];
    if (up >= 30 && up - 30 < use.size()) name = use[up - 30];
    if (code == -1001) name = "CL_PLATFORM_NOT_FOUND_KHR";
    return name + " (" + std::to_string(code) + ")";
}

std::string readable_bytes(std::uint64_t bytes) {
    static constexpr const char* units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    std::size_t unit = 0;
    double value = static_cast<double>(bytes);
    for (; value >= 1024 && unit + 1 < std::size(units); ++unit) value /= 1024;
    char text[32];
    std::snprintf(text, sizeof text, unit ? "%.2f %s" : "%.0f %s", value, units[unit]);
    return text;
}

void Core::check(const char* call, cl_int code, const Where& where) {
    if (code == CL_SUCCESS) return;
    const bool fatal = means_lost(code);
    if (fatal) lost = true;
    std::string text = where.sentence;
    if (text.empty() && means_memory(code))
        text = "The device ran out of memory: " + readable_bytes(allocated) + " were allocated of " +
               readable_bytes(info.memory) + ". Use a smaller picture or scene, or another device.";
    if (text.empty() && fatal)
        text =
            "The device failed and is not used any more. Try again, with another --device or a newer driver.";
    if (!text.empty()) text += ' ';
    text += std::string(call) + " gave " + error_name(code) + " on " + info.name + ", driver " + info.driver +
            " (" + info.platform + ")";
    if (!where.program.empty()) text += ", program " + where.program;
    if (!where.kernel.empty()) text += ", kernel " + where.kernel;
    if (!where.options.empty()) text += ", options " + where.options;
    text += '.';
    if (!where.log.empty()) text += "\nBuild log:\n" + where.log;
    throw DeviceError(means_memory(code) ? Exit::memory : Exit::device, code, text);
}

void Core::require_alive() const {
    if (lost)
        throw DeviceError(Exit::device, CL_DEVICE_NOT_AVAILABLE,
                          "The device " + info.name + " failed earlier and is not used any more.");
}

}  // namespace triad::opencl
