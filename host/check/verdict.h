#pragma once
/// The verdict on a device, driver and set of kernels: found once, kept in the cache folder.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bvh/bvh.h"
#include "check/check.h"
#include "trace/path_driver.h"

namespace triad {

struct Verdict {
    std::vector<std::string> wrong;  ///< names of the cases that failed; empty: the device is right
};

/// Where it is kept; empty: nowhere.
std::filesystem::path verdict_path(const DeviceInfo& device, BvhFormat format, PathDriverKind driver);

/// What an earlier check found; none when there was no check of this device with this driver, these kernels
/// this format of nodes and this path driver.
std::optional<Verdict> load_verdict(const DeviceInfo& device, BvhFormat format,
                                    PathDriverKind driver = PathDriverKind::mega);

/// A cache folder that cannot be written costs a warning only.
void keep_verdict(const DeviceInfo& device, BvhFormat format, const Verdict& verdict,
                  PathDriverKind driver = PathDriverKind::mega);

/// None where nothing is wrong but a case lacked memory, which says nothing about the device.
std::optional<Verdict> verdict_of(const std::vector<CheckResult>& results);

/// Of the quick cases those that each see something else: a few seconds with compilation.
std::vector<CheckCase> first_cases();

/// The kept verdict, or that of the first cases, a few seconds' worth, which says so. None where there is too
/// little memory for them.
std::optional<Verdict> ensure_checked(Device& device);

/// Throws Error(device) that names the wrong cases, if there are any; with `force` it is a warning.
void require_right(const Verdict& verdict, const DeviceInfo& device, bool force);
/// The same of ensure_checked(); Error(memory) where there is none, with `force` a warning.
void require_right(Device& device, bool force);

}  // namespace triad
