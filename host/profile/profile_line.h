#pragma once
/// The time line of a profile's last run, for its page.
#include <string>
#include <vector>

#include "base/spans.h"
#include "profile/profile.h"

namespace triad {

/// HTML with an SVG: the host's threads and the queue, a piece from the middle of the run; empty without
/// commands. The page's style has the colours, classes k0 to k6.
std::string profile_line(const Profile& profile, const std::vector<HostSpan>& spans);

}  // namespace triad
