#pragma once
/// Is this device right? Known answers, all through the real kernels; docs/check.md lists the cases.
/// `triad check` prints them, the device and analytic tests run them: every case exists once, here.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "device/device.h"

namespace triad {

/// How much work the cases do. Bounds of statistical cases follow their counts.
enum class CheckLevel {
    tiny,      ///< the quick cases with a thousandth of the work: simulators
    quick,     ///< about 10 s on two CPU cores
    standard,  ///< about a minute
    full       ///< everything, as the tests run it
};

class Check;

/// A row of the table.
struct CheckCase {
    const char* id;                ///< "C1"; unique
    const char* words;             ///< "watertight edges"
    CheckLevel level;              ///< the least level that runs it (quick, standard or full)
    void (*run)(Check&);           ///< null: no kernel does what the case asks
    const char* absent = nullptr;  ///< why there is none

    std::string name() const { return std::string(id) + " " + words; }
};

/// Of a case: the measurement that came nearest to its bound, or went farthest beyond.
struct CheckResult {
    std::string name;                   ///< id and words
    double value = 0, bound = 0;        ///< right when value <= bound
    std::optional<bool> ok;             ///< none: not applicable
    std::string what;                   ///< what the value measures, where that needs saying
    std::vector<std::string> failures;  ///< a sentence each; the first few
    bool lacked_memory = false;         ///< then ok is false, and says nothing about the device
    double seconds = 0;
};

/// Every case, in the order of the documents: functions first, whole pictures after.
const std::vector<CheckCase>& function_cases();
/// Those among them that trace rays against trees: a device that walks nodes of another format answers them
/// anew.
const std::vector<CheckCase>& traversal_cases();
const std::vector<CheckCase>& picture_cases();

/// The cases of a level, or those of these ids whatever their level. Throws Error(usage) for an unknown id.
std::vector<CheckCase> cases_of(CheckLevel level, const std::vector<std::string>& ids = {});

/// Runs one case. An error of the device or its compiler is a failure of the case, not an exception.
CheckResult run_case(Device& device, const CheckCase& each, CheckLevel level);

/// Runs them in order; `report` is called after each.
std::vector<CheckResult> run_cases(Device& device, const std::vector<CheckCase>& cases, CheckLevel level,
                                   const std::function<void(const CheckResult&)>& report);

}  // namespace triad
