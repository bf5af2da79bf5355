#pragma once
/// Where in the picture a profile's work and time went.
#include "profile/profile_page.h"

namespace triad {

/// Of visits and of the seconds of tiles.
ProfileMaps profile_maps();

}  // namespace triad
