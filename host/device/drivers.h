#pragma once
/// Drivers that die: how this process outlives them, which are left out, and why.
#include "base/restart.h"
#include "device/device.h"
#include "device/icd.h"

namespace triad::opencl {

/// Once per process, before anything else of OpenCL: has the loader load its drivers, but for those that
/// would take the process down or have no library. These are returned, with the reasons.
const std::vector<PlatformProblem>& load_drivers();

/// What a Peril says: while drivers are loaded and their devices listed;
inline constexpr const char* listing_note = "listing";
/// while a driver opens a device or compiles for it, `did` being "compiled shading/path.cl";
std::string compiling_note(const DeviceInfo& device, const std::string& did);
/// while a kernel runs for the first time, which is when some drivers compile it.
std::string running_note(const DeviceInfo& device, const std::string& kernel);

/// Why this device is left out: its driver died of a call, in an earlier life of this process or, when it was
/// compiling, in another process within a day. Empty: it did not.
std::string why_left_out(const DeviceInfo& device);
/// Remembers for a day that the driver died in an earlier life of this process, if it died compiling: of what
/// it ran, it may have died for the sake of one scene.
void keep_death(const DeviceInfo& device);

bool is_pocl(const std::string& platform);

/// Gives PoCL a temporary folder for its cache where its own cannot be written, or where PoCL died of what it
/// holds; before PoCL is loaded.
void place_pocl_cache(const std::vector<Icd>& icds);
/// The sentence that says so; empty where PoCL has its own.
const std::string& pocl_cache_trouble();
/// Whether its own lies on a disk without room for a few programs.
bool is_pocl_cache_full();

}  // namespace triad::opencl
