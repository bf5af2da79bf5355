// An OpenCL driver that misbehaves as real ones did: a platform without devices, one that fails to list them,
// and devices that answer no question, have no compiler, are too old, or say zero to every number. The
// variable OCL_FAKE makes it worse: "abort at load", "abort", "exit" or "hang" when it is asked for
// platforms, or "compiler", a GPU whose compiler divides by zero, or "catching compiler", whose
// compiler aborts and catches that first, as LLVM does.
#include <CL/cl_icd.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

struct _cl_platform_id {
    const cl_icd_dispatch* dispatch;
    const char* name;
};
struct _cl_device_id {
    const cl_icd_dispatch* dispatch;
    const char* name;
    const char* version;
    bool answers, compiler;
};
struct _cl_context {
    const cl_icd_dispatch* dispatch;
};
struct _cl_command_queue {
    const cl_icd_dispatch* dispatch;
};
struct _cl_mem {
    const cl_icd_dispatch* dispatch;
};
struct _cl_program {
    const cl_icd_dispatch* dispatch;
};

namespace {

bool fake(const char* mode) {
    const char* wanted = std::getenv("OCL_FAKE");
    return wanted && std::strcmp(wanted, mode) == 0;
}

const bool loaded = [] {
    if (fake("abort at load")) std::abort();
    return true;
}();

extern const cl_icd_dispatch dispatch;
_cl_platform_id platforms[] = {{&dispatch, "Empty"}, {&dispatch, "Failing"}, {&dispatch, "Odd"}};
_cl_platform_id fragile_platform = {&dispatch, "Brittle"};
_cl_device_id fragile_device = {&dispatch, "Fragile", "OpenCL 1.2", true, true};
_cl_context one_context = {&dispatch};
_cl_command_queue one_queue = {&dispatch};
_cl_mem one_buffer = {&dispatch};
_cl_program one_program = {&dispatch};
_cl_device_id devices[] = {{&dispatch, "Mute", "", false, false},
                           {&dispatch, "No compiler", "OpenCL 3.0", true, false},
                           {&dispatch, "Old", "OpenCL 1.1", true, true},
                           {&dispatch, "Zero", "OpenCL 1.2", true, true}};

cl_int answer(const void* data, size_t bytes, size_t size, void* value, size_t* needed) {
    if (needed) *needed = bytes;
    if (!value) return CL_SUCCESS;
    if (size < bytes) return CL_INVALID_VALUE;
    std::memcpy(value, data, bytes);
    return CL_SUCCESS;
}

cl_int answer(const std::string& text, size_t size, void* value, size_t* needed) {
    return answer(text.c_str(), text.size() + 1, size, value, needed);
}

cl_int CL_API_CALL platform_info(cl_platform_id platform, cl_platform_info what, size_t size, void* value,
                                 size_t* needed) {
    if (what == CL_PLATFORM_NAME) return answer(platform->name, size, value, needed);
    if (what == CL_PLATFORM_EXTENSIONS) return answer("cl_khr_icd", size, value, needed);
    if (what == CL_PLATFORM_ICD_SUFFIX_KHR) return answer("FAKE", size, value, needed);
    return answer("", size, value, needed);
}

cl_int CL_API_CALL device_ids(cl_platform_id platform, cl_device_type, cl_uint room, cl_device_id* list,
                              cl_uint* count) {
    if (platform == &fragile_platform) {
        if (list && room > 0) list[0] = &fragile_device;
        if (count) *count = 1;
        return CL_SUCCESS;
    }
    if (platform == &platforms[0]) return CL_DEVICE_NOT_FOUND;
    if (platform == &platforms[1]) return CL_OUT_OF_HOST_MEMORY;
    for (cl_uint i = 0; list && i < room && i < std::size(devices); ++i) list[i] = &devices[i];
    if (count) *count = std::size(devices);
    return CL_SUCCESS;
}

cl_int CL_API_CALL device_info(cl_device_id device, cl_device_info what, size_t size, void* value,
                               size_t* needed) {
    if (!device->answers) return CL_INVALID_VALUE;
    const auto number = [&](auto n) { return answer(&n, sizeof n, size, value, needed); };
    switch (what) {
        case CL_DEVICE_NAME:
            return answer(device->name, size, value, needed);
        case CL_DEVICE_VERSION:
            return answer(device->version, size, value, needed);
        case CL_DEVICE_AVAILABLE:
        case CL_DEVICE_ENDIAN_LITTLE:
            return number(cl_bool(CL_TRUE));
        case CL_DEVICE_COMPILER_AVAILABLE:
            return number(cl_bool(device->compiler));
        case CL_DEVICE_IMAGE_SUPPORT:
        case CL_DEVICE_MAX_COMPUTE_UNITS:
        case CL_DEVICE_MAX_CLOCK_FREQUENCY:
            return number(cl_uint(0));
        case CL_DEVICE_MAX_WORK_GROUP_SIZE:
            return number(size_t(0));
        case CL_DEVICE_TYPE:
            return number(cl_ulong(device == &fragile_device ? CL_DEVICE_TYPE_GPU : 0));
        case CL_DEVICE_SINGLE_FP_CONFIG:
        case CL_DEVICE_GLOBAL_MEM_SIZE:
        case CL_DEVICE_MAX_MEM_ALLOC_SIZE:
        case CL_DEVICE_LOCAL_MEM_SIZE:
            return number(cl_ulong(0));
        default:
            return answer("", size, value, needed);
    }
}

cl_int CL_API_CALL platform_ids(cl_uint room, cl_platform_id* list, cl_uint* count) {
    if (fake("abort")) {
        std::cerr << "fake driver: cannot go on" << std::endl;
        std::abort();
    }
    if (fake("exit")) std::exit(3);
    if (fake("hang"))
        for (;;) ::pause();
    if (fake("compiler") || fake("catching compiler")) {
        if (list && room > 0) list[0] = &fragile_platform;
        if (count) *count = 1;
        return CL_SUCCESS;
    }
    for (cl_uint i = 0; list && i < room && i < std::size(platforms); ++i) list[i] = &platforms[i];
    if (count) *count = std::size(platforms);
    return CL_SUCCESS;
}

cl_context CL_API_CALL create_context(const cl_context_properties*, cl_uint, const cl_device_id*,
                                      void(CL_CALLBACK*)(const char*, const void*, size_t, void*), void*,
                                      cl_int* error) {
    *error = CL_SUCCESS;
    return &one_context;
}

cl_command_queue CL_API_CALL create_queue(cl_context, cl_device_id, cl_command_queue_properties,
                                          cl_int* error) {
    *error = CL_SUCCESS;
    return &one_queue;
}

cl_mem CL_API_CALL create_buffer(cl_context, cl_mem_flags, size_t, void*, cl_int* error) {
    *error = CL_SUCCESS;
    return &one_buffer;
}

cl_program CL_API_CALL create_program(cl_context, cl_uint, const char**, const size_t*, cl_int* error) {
    *error = CL_SUCCESS;
    return &one_program;
}

cl_int CL_API_CALL build_program(cl_program, cl_uint, const cl_device_id*, const char*,
                                 void(CL_CALLBACK*)(cl_program, void*), void*) {
    if (fake("catching compiler")) {
        std::signal(SIGABRT, [](int) { std::signal(SIGABRT, SIG_DFL); });
        std::abort();
    }
    std::raise(SIGFPE);
    return CL_BUILD_PROGRAM_FAILURE;
}

const cl_icd_dispatch dispatch = [] {
    cl_icd_dispatch table{};
    table.clGetPlatformIDs = platform_ids;
    table.clGetPlatformInfo = platform_info;
    table.clGetDeviceIDs = device_ids;
    table.clGetDeviceInfo = device_info;
    table.clCreateContext = create_context;
    table.clReleaseContext = [](cl_context) -> cl_int { return CL_SUCCESS; };
    table.clCreateCommandQueue = create_queue;
    table.clReleaseCommandQueue = [](cl_command_queue) -> cl_int { return CL_SUCCESS; };
    table.clCreateBuffer = create_buffer;
    table.clReleaseMemObject = [](cl_mem) -> cl_int { return CL_SUCCESS; };
    table.clEnqueueWriteBuffer = [](cl_command_queue, cl_mem, cl_bool, size_t, size_t, const void*, cl_uint,
                                    const cl_event*, cl_event*) -> cl_int { return CL_SUCCESS; };
    table.clEnqueueFillBuffer = [](cl_command_queue, cl_mem, const void*, size_t, size_t, size_t, cl_uint,
                                   const cl_event*, cl_event*) -> cl_int { return CL_SUCCESS; };
    table.clCreateProgramWithSource = create_program;
    table.clReleaseProgram = [](cl_program) -> cl_int { return CL_SUCCESS; };
    table.clBuildProgram = build_program;
    return table;
}();

}  // namespace

// What loaders look up by name.
extern "C" {
cl_int CL_API_CALL clIcdGetPlatformIDsKHR(cl_uint room, cl_platform_id* list, cl_uint* count) {
    return platform_ids(room, list, count);
}
cl_int CL_API_CALL clGetPlatformInfo(cl_platform_id platform, cl_platform_info what, size_t size, void* value,
                                     size_t* needed) {
    return platform_info(platform, what, size, value, needed);
}
void* CL_API_CALL clGetExtensionFunctionAddress(const char* name) {
    if (std::strcmp(name, "clIcdGetPlatformIDsKHR") == 0)
        return reinterpret_cast<void*>(clIcdGetPlatformIDsKHR);
    if (std::strcmp(name, "clGetPlatformInfo") == 0) return reinterpret_cast<void*>(clGetPlatformInfo);
    return nullptr;
}
}
