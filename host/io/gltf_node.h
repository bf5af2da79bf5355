#pragma once
/// Nodes: the transforms that they give.
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"
#include "io/gltf_animation.h"
#include "io/gltf_file.h"

namespace triad::gltf {

dmat4 translate_rotate_scale(const dvec3& translation, const dquat& rotation, const dvec3& scale);

/// True when the matrix can be inverted with some accuracy left.
bool is_invertible(const dmat4& m);

/// `q` at unit length. Throws Error(scene) that names `what` when it has none.
dquat unit_quaternion(const dquat& q, const std::string& what);

/// The nodes of a file in a pose.
class Nodes {
  public:
    Nodes(File& file, Pose pose);

    /// From the node's space to its scene's. Throws Error(scene) that names a node on the way.
    const dmat4& to_world(std::size_t node);
    /// Of the morph targets of the node's mesh: as posed, else the node's own, else the mesh's. Empty where
    /// all are zero.
    std::vector<double> weights(std::size_t node) const;

  private:
    dmat4 local_transform(std::size_t node);

    File& file_;
    Pose pose_;
    std::vector<int> parents_;  ///< -1: none
    std::vector<std::optional<dmat4>> to_world_;
};

/// The node's extension of this name; null: it has none.
const tinygltf::Value* extension_of(const tinygltf::Node& node, const char* name);

}  // namespace triad::gltf
