#pragma once
/// What this project adds to glTF by "extras": {"triad": {...}}. docs/extras.schema.json describes it.
#include <functional>
#include <string>

#include "io/gltf_file.h"

namespace triad::gltf {

using Warn = std::function<void(const std::string&)>;

/// A material's glass, cauchy, sellmeier and priority. A glass also sets the index of refraction. Throws
/// Error(scene) that names `what` and the member; a member that is not known is a warning.
void apply_material_extras(const tinygltf::Value& extras, const std::string& what, Material& material,
                           const Warn& warn);

}  // namespace triad::gltf
