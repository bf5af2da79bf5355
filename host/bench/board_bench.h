#pragma once
/// Measures of a board that need no files: each returns rows, and is a step of `triad bench device`.
#include <functional>
#include <map>
#include <vector>

#include "bench/board.h"
#include "bvh/bvh.h"
#include "profile/device_peaks.h"
#include "trace/path_driver.h"
#include "trace/work_counter.h"

namespace triad {

/// How a device follows paths, and which nodes their rays walk.
struct PathWay {
    BvhFormat format;
    PathDriverKind driver;
    std::string text() const { return std::string(name_of(driver)) + ", " + name_of(format); }
};
/// All that make sense on the device, the one that it is set to first.
std::vector<PathWay> path_ways(const Device& device);
/// From now on the device goes this way.
void set_way(Device& device, const PathWay& way);

/// Fused multiply-adds, reads, copies and dependent reads.
std::vector<BoardRow> rows_of(const DevicePeaks& peaks);

/// The built-in scene, by a way that it is to follow paths: samples per second, and every kernel alone. Work
/// is counted for each format once, in `counts`.
std::vector<BoardRow> measure_paths(Device& device, const PathWay& way, const DevicePeaks& peaks,
                                    std::map<BvhFormat, WorkCounts>& counts);

/// Kernels of three pipelines from bins to pixels.
std::vector<BoardRow> measure_display(Device& device);

/// Every function of the kernels in one of its own (bench/kernel_bench.h), until `go_on` says no.
std::vector<BoardRow> measure_functions(Device& device, const std::function<bool()>& go_on);

}  // namespace triad
