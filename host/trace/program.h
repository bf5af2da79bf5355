#pragma once
/// Names of programs.
#include <string>

#include "pack/settings.h"

namespace triad {

/// The program that traces (or records) paths with these settings.
inline std::string program_of(const RenderSettings& settings, const std::string& what) {
    return "path/" + what + (settings.spectral == Spectral::full ? "_full.cl" : ".cl");
}

}  // namespace triad
