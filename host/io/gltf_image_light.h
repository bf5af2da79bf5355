#pragma once
/// EXT_lights_image_based: the light around a scene.
#include <optional>

#include "io/gltf_file.h"
#include "scene/scene.h"

namespace triad::gltf {

/// Of the light that this scene of the file names; none: it names none. Damaged images are faults of the
/// file. Throws Error(scene) that names the light.
std::optional<EnvironmentMap> image_light(File& file, std::size_t scene);

}  // namespace triad::gltf
