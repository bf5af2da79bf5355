#pragma once
/// Solid bodies that touch: glass in which water stands.
#include <vector>

#include "pack/pack.h"

namespace triad {

/// The tree keeps one of two triangles that coincide. Where they are the surfaces of two bodies that face
/// each other, the one that is kept must know the body on its other side (Geometry.touching): these triangles
/// are given to geometries of their own, copies that say so. `flat`: what the world's tree is built over, by
/// rising primitive.
void note_touching(const Scene& scene, PackedScene& packed, std::vector<BvhTriangle>& flat);

}  // namespace triad
