#pragma once
/// A profile beside an earlier one.
#include <string>
#include <vector>

#include "device/report.h"
#include "profile/profile.h"

namespace triad {

/// A kernel now and in an earlier report.
struct KernelChange {
    std::string kernel, device;
    double before_ms = 0, now_ms = 0;  ///< of a run
    Estimate ratio;                    ///< now over before
    bool is_slower = false;            ///< beyond noise, and one that matters
};

/// What --json of `command` ("profile", "replay") wrote. Throws Error(scene) when it is no such report.
Json earlier_report(const std::string& path, const std::string& command);

/// Before anything is measured. Throws Error(usage) when the report is of other work.
void require_same_work(const Json& before, const Json& workload);
/// The same. Throws Error(usage) when so many runs on this device have nothing in the report to be set
/// beside.
void require_comparable(const Json& before, const DeviceInfo& device, unsigned runs);

/// Those that both have. `before`: an earlier_report() of the same work. Throws Error(usage) when there are
/// none.
std::vector<KernelChange> changes_since(const Json& before, const std::vector<Profile>& profiles);
std::string table_of(const std::vector<KernelChange>& changes);
bool any_slower(const std::vector<KernelChange>& changes);

}  // namespace triad
