#pragma once
/// Skins: where joints have taken a mesh.
#include <vector>

#include "base/math.h"
#include "io/gltf_pose.h"

namespace triad::gltf {

struct Skin {
    /// From the mesh as it was bound to the world, moved by -centre.
    std::vector<dmat4> joints;
    dvec3 centre{0.0};  ///< of the joints, in the world: near to it floats are exact
};

/// Throws Error(scene) that names the skin.
Skin skin_at(File& file, PosedNodes& nodes, int skin);

}  // namespace triad::gltf
