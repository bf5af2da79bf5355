#pragma once
/// A profile as text and as JSON.
#include <string>
#include <vector>

#include "device/report.h"
#include "profile/profile.h"

namespace triad {

/// Tables for a terminal: kernels, rays, and what else took time; of several devices also side by side.
std::string table_of(const std::vector<Profile>& profiles);

/// The first of them.
std::string kernels_table(const Profile& profile);

/// How many rays follow an edge of the paths, counted from the camera's: how long the lists of a wave would
/// be, per sample.
struct EdgeLine {
    std::string name;  ///< "1", ..., "16 and later"
    double rays = 0, hits = 0, shadow_rays = 0;
};
/// Up to the last that has any.
std::vector<EdgeLine> edge_lines(const WorkCounts& counts);

/// The rows of --json: kernels by falling share, device after device.
Json rows_of(const std::vector<Profile>& profiles);
/// What is no row of a kernel: "peaks", "rays", "memory", "compilations", "queue" of each device.
Json devices_of(const std::vector<Profile>& profiles);

/// Trace Event Format, which Perfetto and chrome://tracing show: the host's threads and the device's queue on
/// one time line, microseconds from the first span on.
Json trace_of(const Profile& profile, const std::vector<HostSpan>& spans);

}  // namespace triad
