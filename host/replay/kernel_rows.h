#pragma once
/// What launches took, by kernel: the rows of triad-replay's table and of its JSON.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "device/report.h"

namespace triad {

struct LaunchRow {
    std::string kernel;
    std::size_t launches = 0;                        ///< of one run of the work
    std::uint64_t items = 0;                         ///< work-items of these
    double ms_median = 0, ms_p95 = 0, ms_total = 0;  ///< of a launch; of one run
    double share = 0;                                ///< of what all kernels took
    double items_per_s = 0;
};

/// Items of one run, by kernel, and the seconds of each launch in `runs` runs. The longest first.
std::vector<LaunchRow> kernel_rows(const std::map<std::string, std::uint64_t>& items,
                                   const std::map<std::string, std::vector<double>>& seconds, unsigned runs);

Json to_json(const std::vector<LaunchRow>& rows);
/// Lines for a terminal, with a head.
std::string table_text(const std::vector<LaunchRow>& rows);

}  // namespace triad
