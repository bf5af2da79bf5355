// An OpenCL driver that misbehaves as real ones did: a platform without devices, one that fails to list them,
// and devices that answer no question, have no compiler, are too old, or say zero to every number.
#include <CL/cl_icd.h>

#include <cstring>
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

namespace {

extern const cl_icd_dispatch dispatch;
_cl_platform_id platforms[] = {{&dispatch, "Empty"}, {&dispatch, "Failing"}, {&dispatch, "Odd"}};
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
    for (cl_uint i = 0; list && i < room && i < std::size(platforms); ++i) list[i] = &platforms[i];
    if (count) *count = std::size(platforms);
    return CL_SUCCESS;
}

const cl_icd_dispatch dispatch = [] {
    cl_icd_dispatch table{};
    table.clGetPlatformIDs = platform_ids;
    table.clGetPlatformInfo = platform_info;
    table.clGetDeviceIDs = device_ids;
    table.clGetDeviceInfo = device_info;
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
