#pragma once
/// Vertices as morph targets and joints move them, in double precision.
#include <string>
#include <vector>

#include "io/gltf_skin.h"
#include "scene/scene.h"

namespace triad::gltf {

struct Deformation {
    std::vector<double> weights;  ///< of the morph targets; empty: all zero
    const Skin* skin = nullptr;   ///< null: none
};

/// Moves the vertices of `primitive`, which are as the file gives them, and turns the triangles around that
/// joints have mirrored. First the targets, then the joints, whose weights count in proportion. Normals and
/// tangents are left without unit length. Throws Error(scene) that starts with `what`.
void deform(File& file, const tinygltf::Primitive& source, const Deformation& deformation,
            Primitive& primitive, const std::string& what);

}  // namespace triad::gltf
