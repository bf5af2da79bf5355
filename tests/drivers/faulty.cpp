// A library to be loaded before OpenCL's (LD_PRELOAD): every call that Triad makes goes through it to the
// real one, and one of them fails on command. TRIAD_FAULT is "CONTEXT CALL N CODE once|ever": of the
// CONTEXT-th context that the process creates (from 0; -2: of every one, each with counts of its own), the
// N-th CALL (from 1; "any" counts all together) returns CODE, or that and all later calls of that context do.
// A CODE of 1 is a call that succeeds and does nothing: of clSetEventCallback, a device that never answers;
// of clEnqueueReadBuffer, one that brings garbage. TRIAD_FAULT_COUNTS names a file that gets "CONTEXT CALL
// COUNT" lines when the process ends.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace {

constexpr long every_context = -2;

struct Fault {
    long context = -1, n = 0;
    std::string call, how;
    cl_int code = 0;
};

struct State {
    std::mutex mutex;
    std::map<const void*, long> context_of;  ///< of contexts, queues, programs, kernels
    std::map<std::pair<long, std::string>, long> counts;
    long contexts = 0;
    std::set<long> failed;
    Fault fault;

    State() {
        if (const char* text = std::getenv("TRIAD_FAULT"))
            std::istringstream(text) >> fault.context >> fault.call >> fault.n >> fault.code >> fault.how;
    }
    ~State() {
        const char* path = std::getenv("TRIAD_FAULT_COUNTS");
        FILE* file = path ? std::fopen(path, "w") : nullptr;
        if (!file) return;
        for (const auto& [key, count] : counts)
            std::fprintf(file, "%ld %s %ld\n", key.first, key.second.c_str(), count);
        std::fclose(file);
    }

    long context(const void* object) {
        const auto found = context_of.find(object);
        return found == context_of.end() ? -1 : found->second;
    }
    /// Counts the call; the code that it is to fail with, or success.
    cl_int next(const char* call, long context) {
        const long count = ++counts[{context, call}], any = ++counts[{context, "any"}];
        if (context != fault.context && fault.context != every_context) return CL_SUCCESS;
        const bool now = (fault.call == call && count == fault.n) || (fault.call == "any" && any == fault.n);
        if (now) failed.insert(context);
        return now || (failed.contains(context) && fault.how == "ever") ? fault.code : CL_SUCCESS;
    }
};

State& state() {
    static State s;
    return s;
}

cl_int fails(const char* call, const void* of) {
    const std::lock_guard lock(state().mutex);
    return state().next(call, state().context(of));
}

/// What was made of `of` belongs to its context.
void made(const void* object, const void* of) {
    const std::lock_guard lock(state().mutex);
    if (object) state().context_of[object] = state().context(of);
}

template <class F>
F* real(const char* name) {
    return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// A call whose first argument is of a context and which returns a code.
#define PASS(NAME, PARAMETERS, ...)                                      \
    extern "C" cl_int NAME PARAMETERS {                                  \
        if (const cl_int code = fails(#NAME, first); code != CL_SUCCESS) \
            return code > 0 ? CL_SUCCESS : code;                         \
        return real<cl_int PARAMETERS>(#NAME)(__VA_ARGS__);              \
    }
// One that makes something of it.
#define MAKE(TYPE, NAME, PARAMETERS, ...)                                      \
    extern "C" TYPE NAME PARAMETERS {                                          \
        if (const cl_int failed = fails(#NAME, first); failed != CL_SUCCESS) { \
            if (code) *code = failed;                                          \
            return nullptr;                                                    \
        }                                                                      \
        TYPE object = real<TYPE PARAMETERS>(#NAME)(__VA_ARGS__);               \
        made(object, first);                                                   \
        return object;                                                         \
    }

extern "C" cl_context clCreateContext(const cl_context_properties* properties, cl_uint count,
                                      const cl_device_id* devices,
                                      void (*notify)(const char*, const void*, size_t, void*), void* data,
                                      cl_int* code) {
    long context;
    {
        const std::lock_guard lock(state().mutex);
        context = state().contexts++;
        if (const cl_int failed = state().next("clCreateContext", context); failed != CL_SUCCESS) {
            if (code) *code = failed;
            return nullptr;
        }
    }
    cl_context made =
        real<decltype(clCreateContext)>("clCreateContext")(properties, count, devices, notify, data, code);
    const std::lock_guard lock(state().mutex);
    if (made) state().context_of[made] = context;
    return made;
}

MAKE(cl_command_queue, clCreateCommandQueue,
     (cl_context first, cl_device_id device, cl_command_queue_properties properties, cl_int* code), first,
     device, properties, code)
MAKE(cl_mem, clCreateBuffer, (cl_context first, cl_mem_flags flags, size_t size, void* host, cl_int* code),
     first, flags, size, host, code)
MAKE(cl_program, clCreateProgramWithSource,
     (cl_context first, cl_uint count, const char** strings, const size_t* lengths, cl_int* code), first,
     count, strings, lengths, code)
MAKE(cl_program, clCreateProgramWithBinary,
     (cl_context first, cl_uint count, const cl_device_id* devices, const size_t* lengths,
      const unsigned char** binaries, cl_int* status, cl_int* code),
     first, count, devices, lengths, binaries, status, code)
MAKE(cl_kernel, clCreateKernel, (cl_program first, const char* name, cl_int* code), first, name, code)
PASS(clBuildProgram,
     (cl_program first, cl_uint count, const cl_device_id* devices, const char* options,
      void (*notify)(cl_program, void*), void* data),
     first, count, devices, options, notify, data)
PASS(clGetProgramInfo, (cl_program first, cl_program_info what, size_t size, void* value, size_t* needed),
     first, what, size, value, needed)
PASS(clGetKernelInfo, (cl_kernel first, cl_kernel_info what, size_t size, void* value, size_t* needed), first,
     what, size, value, needed)
PASS(clGetKernelWorkGroupInfo,
     (cl_kernel first, cl_device_id device, cl_kernel_work_group_info what, size_t size, void* value,
      size_t* needed),
     first, device, what, size, value, needed)
PASS(clSetKernelArg, (cl_kernel first, cl_uint index, size_t size, const void* value), first, index, size,
     value)
PASS(clEnqueueNDRangeKernel,
     (cl_command_queue first, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
      const size_t* global, const size_t* local, cl_uint count, const cl_event* events, cl_event* event),
     first, kernel, dimensions, offset, global, local, count, events, event)
PASS(clEnqueueWriteBuffer,
     (cl_command_queue first, cl_mem buffer, cl_bool wait, size_t offset, size_t size, const void* data,
      cl_uint count, const cl_event* events, cl_event* event),
     first, buffer, wait, offset, size, data, count, events, event)
extern "C" cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool wait, size_t offset,
                                      size_t size, void* data, cl_uint count, const cl_event* events,
                                      cl_event* event) {
    const cl_int failed = fails("clEnqueueReadBuffer", queue);
    if (failed < 0) return failed;
    const cl_int code = real<decltype(clEnqueueReadBuffer)>("clEnqueueReadBuffer")(
        queue, buffer, wait, offset, size, data, count, events, event);
    if (failed > 0) std::memset(data, 0x7f, size);
    return code;
}
PASS(clEnqueueFillBuffer,
     (cl_command_queue first, cl_mem buffer, const void* pattern, size_t pattern_size, size_t offset,
      size_t size, cl_uint count, const cl_event* events, cl_event* event),
     first, buffer, pattern, pattern_size, offset, size, count, events, event)
PASS(clFinish, (cl_command_queue first), first)
PASS(clFlush, (cl_command_queue first), first)
PASS(clSetEventCallback, (cl_event first, cl_int status, void (*notify)(cl_event, cl_int, void*), void* data),
     first, status, notify, data)

extern "C" cl_int clEnqueueMarkerWithWaitList(cl_command_queue queue, cl_uint count, const cl_event* events,
                                              cl_event* event) {
    if (const cl_int code = fails("clEnqueueMarkerWithWaitList", queue); code != CL_SUCCESS) return code;
    const cl_int code = real<decltype(clEnqueueMarkerWithWaitList)>("clEnqueueMarkerWithWaitList")(
        queue, count, events, event);
    if (code == CL_SUCCESS && event) made(*event, queue);
    return code;
}
