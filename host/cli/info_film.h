#pragma once
#include <string>

#include "base/error.h"

namespace triad {

/// triad info FILM: what a film holds, of what picture, and whether it is whole and complete. Throws
/// Error(scene) when nothing of it can be read.
Exit info_film(const std::string& path, const std::string& json);

}  // namespace triad
