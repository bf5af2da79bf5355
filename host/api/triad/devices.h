#pragma once
/// What there is: devices, panels, this library.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "triad/error.h"

namespace triad::api {

/// "0.1.0"
TRIAD_API std::string version();

/// What is said on standard error: 0 nothing, 1 warnings and what a user should know (at first), 2 more.
/// Throws Error(1).
TRIAD_API void set_verbosity(int level);

/// An OpenCL device with its driver.
struct Device {
    std::size_t index = 0;  ///< option "device" takes it
    std::string name{}, platform{}, driver{};
    std::string type{};  ///< "cpu", "gpu", "accelerator" or "other"
    unsigned compute_units = 0;
    std::uint64_t memory = 0;  ///< bytes
    bool usable = false;
    bool chosen = false;         ///< where nothing else is asked for
    std::string why_unusable{};  ///< a sentence; empty: it is usable
};

/// Every device, in the order of their indices; none is an empty list.
TRIAD_API std::vector<Device> devices();

/// A display that pictures can be made for (option "panel").
struct Panel {
    std::string name{}, description{};
};
/// The built-in ones. Each also turned ("qd-oled@90") or mirrored ("rgb@flip").
TRIAD_API std::vector<Panel> panels();

/// An answer of a device that is known beforehand (docs/check.md).
struct CheckResult {
    std::string name{};                 ///< "C1 watertight edges"
    double value = 0, bound = 0;        ///< right when value <= bound
    std::optional<bool> right{};        ///< none: not applicable
    std::vector<std::string> faults{};  ///< a sentence each; the first few
    double seconds = 0;
};

/// Proves a device and its driver, as `triad check` does, and keeps the verdict: "quick" takes seconds,
/// "standard" about a minute, "full" more. `cases` are ids like "C1"; empty: all of the level. `report` is
/// called after each; false leaves the others out. Throws Error.
TRIAD_API std::vector<CheckResult> check(const std::string& device = {},
                                         const std::string& level = "standard",
                                         const std::vector<std::string>& cases = {},
                                         const std::function<bool(const CheckResult&)>& report = {});

}  // namespace triad::api
