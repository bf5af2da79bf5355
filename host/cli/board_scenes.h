#pragma once
/// The suite's scenes as `triad bench device` renders them: of the size of the references that come with the
/// program, by paths alone.
#include <filesystem>

#include "bench/board_errors.h"
#include "cli/experiment.h"

namespace triad {

/// `folder`: that of suite_scenes(). Throws Error(scene) where the scene or its reference,
/// references/NAME.exr there, is missing or is no reference.
BoardScene board_scene(const NamedOptions& scene, const std::filesystem::path& folder);

}  // namespace triad
