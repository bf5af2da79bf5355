#pragma once
/// A profile as one page that needs nothing else.
#include <functional>
#include <string>
#include <vector>

#include "base/spans.h"
#include "profile/profile.h"

namespace triad {

/// Maps of the picture (report/profile_maps.h): images, which not every program can write.
struct ProfileMaps {
    std::string css;
    std::function<std::string(const Profile&)> html;
};

/// HTML: shares, roofline, rays, lists, time line of the last run, maps, memory. `command`: what made it.
/// Warns where gnuplot, which draws the roofline, is missing.
std::string profile_page(const std::vector<Profile>& profiles, const std::vector<HostSpan>& spans,
                         const std::string& command, const ProfileMaps& maps = {});

/// The roofline of a device and where its kernels lie, as a gnuplot script; empty without such kernels.
std::string roofline_script(const Profile& profile);

}  // namespace triad
