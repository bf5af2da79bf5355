#pragma once
/// A profile as one page that needs nothing else.
#include <string>
#include <vector>

#include "base/spans.h"
#include "bench/profile.h"

namespace triad {

/// HTML: shares, roofline, rays, time line of the last run, heat maps of the picture, memory. `command`: what
/// made it. Warns where gnuplot, which draws the roofline, is missing.
std::string profile_page(const std::vector<Profile>& profiles, const std::vector<HostSpan>& spans,
                         const std::string& command);

/// The roofline of a device and where its kernels lie, as a gnuplot script; empty without such kernels.
std::string roofline_script(const Profile& profile);

}  // namespace triad
