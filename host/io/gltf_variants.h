#pragma once
/// KHR_materials_variants: other materials for the same primitives, by name.
#include <string>
#include <vector>

#include "io/gltf_file.h"

namespace triad::gltf {

std::vector<std::string> variant_names(const File& file);

/// The variant of that name; -1 for an empty one. Throws Error(usage) that lists those there are.
int find_variant(const File& file, const std::string& name);

/// The glTF material of a primitive in this variant (-1: none chosen); where it maps nothing, its own.
int material_of(const tinygltf::Primitive& primitive, int variant);

}  // namespace triad::gltf
