#pragma once
/// Members of extensions that check_document() found to be of their type.
#include "io/gltf_file.h"

namespace triad::gltf {

/// None: the object does not have this extension.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name);

/// A member that is a number, or its default.
double number(const tinygltf::Value& object, const char* member, double otherwise);

/// The first three numbers of a member, or its default.
vec3 colour(const tinygltf::Value& object, const char* member, const vec3& otherwise);

/// Clamped to [0, 1].
float to_unit(double x);

}  // namespace triad::gltf
