#pragma once
/// The part of `triad info` that needs no scene: what the file holds and what becomes of its extensions.
#include <nlohmann/json.hpp>

#include "io/gltf_contents.h"

namespace triad {

void print(const GltfContents& contents);

/// The same as members of a JSON row.
nlohmann::ordered_json to_json(const GltfContents& contents);

}  // namespace triad
