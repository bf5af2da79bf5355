#pragma once
/// What this project adds to glTF by "extras": {"triad": {...}}. docs/schema/extras.schema.json describes it.
#include <functional>
#include <string>

#include "io/gltf_file.h"

namespace triad::gltf {

using Warn = std::function<void(const std::string&)>;

/// A material's glass, cauchy, sellmeier, priority and spectrum. A glass also sets the index of refraction.
/// Throws Error(scene) that names `what` and the member; a member that is not known is a warning.
void apply_material_extras(const tinygltf::Value& extras, const std::string& what, Material& material,
                           const Warn& warn);

/// The spectrum of a punctual light; none: D65. Throws and warns alike.
std::optional<LightSpectrum> light_extras(const tinygltf::Value& extras, const std::string& what,
                                          const Warn& warn);

}  // namespace triad::gltf
