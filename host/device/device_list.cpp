#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <tuple>

#include "base/log.h"
#include "base/shell_limits.h"
#include "device/opencl.h"

namespace triad::opencl {
namespace {

/// Of Intel's runtime for CPUs.
constexpr const char* vectorizer_mode = "CL_CONFIG_CPU_VECTORIZER_MODE";

/// A driver may fail any query: the text is empty then, the number zero, both legal answers.
template <class Get, class Object, class What>
std::string text_of(Get get, Object object, What what) {
    std::size_t size = 0;
    if (get(object, what, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
    std::string text(size, '\0');
    if (get(object, what, size, text.data(), nullptr) != CL_SUCCESS) return {};
    text.resize(std::min(text.find('\0'), text.size()));
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    text.erase(0, text.find_first_not_of(" \t"));
    return text;
}

template <class T>
T number_of(cl_device_id device, cl_device_info what) {
    T value{};
    return clGetDeviceInfo(device, what, sizeof value, &value, nullptr) == CL_SUCCESS ? value : T{};
}

std::string type_name(cl_device_type type) {
    if (type & CL_DEVICE_TYPE_GPU) return "gpu";
    if (type & CL_DEVICE_TYPE_CPU) return "cpu";
    if (type & CL_DEVICE_TYPE_ACCELERATOR) return "accelerator";
    return "other";
}

/// "OpenCL 1.2 ..." and "OpenCL C 1.2 ..." as 102; 0 when it cannot be read.
int version_number(const std::string& text) {
    const std::size_t digit = text.find_first_of("0123456789");
    int major = 0, minor = 0;
    if (digit == std::string::npos || std::sscanf(text.c_str() + digit, "%d.%d", &major, &minor) != 2)
        return 0;
    return major * 100 + minor;
}

std::string why_unusable(cl_device_id device, const DeviceInfo& info) {
    if (!number_of<cl_bool>(device, CL_DEVICE_AVAILABLE))
        return "The driver says that the device is not available.";
    if (!number_of<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE))
        return "The driver has no compiler for OpenCL C; install the full version of the driver.";
    if (version_number(info.version) < 102)
        return "It offers \"" + info.version + "\"; OpenCL 1.2 is the least that the kernels need.";
    if (!number_of<cl_bool>(device, CL_DEVICE_ENDIAN_LITTLE))
        return "It is big-endian; scenes are packed for little-endian devices.";
    return {};
}

/// The place on the PCI bus by the extensions of Khronos, NVIDIA and AMD; empty where none tells.
std::string pci_place(cl_device_id device) {
    struct {
        cl_uint domain, bus, device, function;
    } khronos{};
    struct {
        cl_uint type;
        cl_uchar unused[17], bus, device, function;
    } amd{};
    constexpr cl_device_info khronos_info = 0x410F, nvidia_bus = 0x4008, nvidia_slot = 0x4009,
                             amd_topology = 0x4037;
    cl_uint bus = 0, slot = 0;
    if (clGetDeviceInfo(device, khronos_info, sizeof khronos, &khronos, nullptr) == CL_SUCCESS) {
        bus = khronos.bus, slot = khronos.device;
    } else if (clGetDeviceInfo(device, nvidia_bus, sizeof bus, &bus, nullptr) == CL_SUCCESS &&
               clGetDeviceInfo(device, nvidia_slot, sizeof slot, &slot, nullptr) == CL_SUCCESS) {
        slot >>= 3;  // the rest is the function
    } else if (clGetDeviceInfo(device, amd_topology, sizeof amd, &amd, nullptr) == CL_SUCCESS &&
               amd.type == 1) {
        bus = amd.bus, slot = amd.device;
    } else {
        return {};
    }
    return "pci " + std::to_string(bus) + ":" + std::to_string(slot);
}

DeviceInfo describe(cl_device_id device, const std::string& platform) {
    const auto text = [&](cl_device_info what) { return text_of(clGetDeviceInfo, device, what); };
    DeviceInfo info;
    info.name = text(CL_DEVICE_NAME);
    info.vendor = text(CL_DEVICE_VENDOR);
    info.platform = platform;
    info.version = text(CL_DEVICE_VERSION);
    info.c_version = text(CL_DEVICE_OPENCL_C_VERSION);
    info.driver = text(CL_DRIVER_VERSION);
    info.type = type_name(number_of<cl_device_type>(device, CL_DEVICE_TYPE));
    info.memory = number_of<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE);
    info.max_allocation = number_of<cl_ulong>(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    info.local_memory = number_of<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE);
    info.compute_units = number_of<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS);
    info.clock_mhz = number_of<cl_uint>(device, CL_DEVICE_MAX_CLOCK_FREQUENCY);
    info.max_work_group = number_of<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE);
    info.host_memory = number_of<cl_bool>(device, CL_DEVICE_HOST_UNIFIED_MEMORY);
    info.images = number_of<cl_bool>(device, CL_DEVICE_IMAGE_SUPPORT);
    const auto single = number_of<cl_device_fp_config>(device, CL_DEVICE_SINGLE_FP_CONFIG);
    info.correctly_rounded = single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
    info.denormals = single & CL_FP_DENORM;
    const std::string extensions = ' ' + text(CL_DEVICE_EXTENSIONS) + ' ';
    info.fp64 = extensions.find(" cl_khr_fp64 ") != std::string::npos;
    info.int64_atomics = extensions.find(" cl_khr_int64_base_atomics ") != std::string::npos;
    info.why_unusable = why_unusable(device, info);
    const char* mode = std::getenv(vectorizer_mode);
    if (platform.find("Intel") != std::string::npos && info.type == "cpu" && mode)
        info.settings.push_back(std::string(vectorizer_mode) + "=" + mode +
                                (mode == std::string("1")
                                     ? " keeps this driver from vectorising across "
                                       "work-items, where it gets calls with vectors of three wrong"
                                     : " is set by the user; 1 is what makes this driver "
                                       "right"));
    info.usable = info.why_unusable.empty();
    return info;
}

/// Greater is better: a GPU before a CPU before anything else, then more compute units, then the lower index.
auto rank(const DeviceInfo& info) {
    const int type = info.type == "gpu" ? 2 : info.type == "cpu" ? 1 : 0;
    return std::tuple(info.usable, type, info.compute_units, -static_cast<long>(info.index));
}

bool better(const Found& a, const Found& b) { return rank(a.info) > rank(b.info); }

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool matches(const DeviceInfo& info, const std::string& selector) {
    if (selector.empty()) return true;
    if (selector.find_first_not_of("0123456789") == std::string::npos)
        return std::to_string(info.index) == selector;
    const std::string wanted = lower(selector);
    if (wanted == "cpu" || wanted == "gpu" || wanted == "accelerator") return info.type == wanted;
    return lower(info.name).find(wanted) != std::string::npos ||
           lower(info.platform).find(wanted) != std::string::npos;
}

std::string list_of(const std::vector<Found>& found) {
    std::string text;
    for (const auto& [platform, device, info, left_out] : found)
        text += "\n  " + std::to_string(info.index) + "  " + info.name + " (" + info.type + ", " +
                info.platform + ")" + (info.usable ? "" : ": " + info.why_unusable);
    return text;
}

/// What -v says of what was passed over.
void tell(const std::vector<PlatformProblem>& problems, const std::vector<Found>& found) {
    for (const auto& [platform, why] : problems) detail("Platform " + platform + " is left out. " + why);
    for (const Found& each : found)
        if (!each.info.usable) detail(each.info.name + " is left out. " + each.info.why_unusable);
}

}  // namespace

std::string platform_text(cl_platform_id platform, cl_platform_info what) {
    return text_of(clGetPlatformInfo, platform, what);
}

std::vector<Found> ask_drivers(std::vector<PlatformProblem>& problems) {
    std::vector<Found> found;
    cl_uint count = 0;
    // CL_PLATFORM_NOT_FOUND_KHR (-1001) and any other failure mean the same here: nothing is installed that
    // works.
    if (clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS || count == 0) return found;
    std::vector<cl_platform_id> platforms(count);
    if (clGetPlatformIDs(count, platforms.data(), nullptr) != CL_SUCCESS) return found;
    for (cl_platform_id platform : platforms) {
        const std::string name = platform_text(platform, CL_PLATFORM_NAME);
        std::vector<cl_device_id> devices;
        cl_int code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
        if (code == CL_SUCCESS && count > 0) {
            devices.resize(count);
            code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr);
        }
        if (code != CL_SUCCESS || devices.empty()) {
            problems.push_back(
                {name, code == CL_DEVICE_NOT_FOUND || code == CL_SUCCESS
                           ? "The platform is installed but offers no device."
                           : "The platform cannot list its devices: " + error_name(code) + "."});
            continue;
        }
        for (cl_device_id device : devices) {
            found.push_back({platform, device, describe(device, name)});
            DeviceInfo& info = found.back().info;
            info.index = found.size() - 1;
            // All CPU devices are drivers of the one machine's processors.
            info.hardware = info.type == "cpu" ? "cpu" : pci_place(device);
            if (info.hardware.empty()) info.hardware = "device " + std::to_string(info.index);
        }
    }
    return found;
}

std::vector<Found> find_devices(std::vector<PlatformProblem>& problems) {
    // Intel's runtime for CPUs reads this when it is loaded; no other driver knows it. Vectorising whole
    // kernels across work-items, its default, makes Triad's several times slower in groups of 64 (their
    // vectors lie within a ray) and gets calls with vectors of three wrong (docs/kernels.md). A value that
    // the user has set stays.
    ::setenv(vectorizer_mode, "1", 0);
    const Peril peril(listing_note);
    problems = load_drivers();
    std::vector<Found> found = ask_drivers(problems);
    for (Found& each : found) {
        if (is_pocl(each.info.platform) && !pocl_cache_trouble().empty()) warn(pocl_cache_trouble());
        const std::string why = why_left_out(each.info);
        if (why.empty()) continue;
        each.left_out = true, each.info.usable = false, each.info.why_unusable = why;
    }
    const auto best = std::min_element(found.begin(), found.end(), better);
    if (best == found.end() || !best->info.usable) return found;
    best->info.preferred = true;
    // Only where another device remains: an only one that died for want of memory must not be lost for a day.
    for (const Found& each : found)
        if (each.left_out) keep_death(each.info);
    return found;
}

Found choose(const std::string& selector) {
    std::vector<PlatformProblem> problems;
    std::vector<Found> found = find_devices(problems);
    tell(problems, found);
    if (found.empty()) {
        std::string text =
            "There is no OpenCL device. Install a driver: your GPU's, or PoCL, which runs on the CPU "
            "(apt-get install pocl-opencl-icd).";
        for (const auto& [platform, why] : problems) text += "\n  " + platform + ": " + why;
        if (const std::string limits = shell_limits(); !limits.empty())
            text += "\n  The shell's limits (" + limits + ") may be what keeps a driver from loading.";
        throw Error(Exit::device, text);
    }
    std::vector<Found> matching;
    std::copy_if(found.begin(), found.end(), std::back_inserter(matching),
                 [&](const Found& each) { return matches(each.info, selector); });
    const auto best = std::min_element(matching.begin(), matching.end(), better);
    if (best != matching.end() && best->info.usable) return *best;
    const auto left_out = std::ranges::find_if(matching, &Found::left_out);
    if (!selector.empty() && left_out != matching.end())
        throw Error(Exit::device, left_out->info.name + " cannot be used. " + left_out->info.why_unusable);
    if (selector.empty())
        throw Error(Exit::device, "No OpenCL device is usable. There are:" + list_of(found));
    const bool is_index = selector.find_first_not_of("0123456789") == std::string::npos;
    for (const auto& [driver, why] : problems)
        if (!is_index && lower(driver).find(lower(selector)) != std::string::npos)
            throw Error(Exit::device, "The OpenCL driver " + driver + " cannot be used. " + why);
    throw Error(Exit::usage, "No usable device is called \"" + selector +
                                 "\" (an index, cpu, gpu, or part of a name). There are:" + list_of(found));
}

}  // namespace triad::opencl

namespace triad {

DeviceList list_devices() {
    DeviceList list;
    for (auto& found : opencl::find_devices(list.problems)) list.devices.push_back(std::move(found.info));
    return list;
}

}  // namespace triad
