#pragma once
/// Nodes of the document.
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"

namespace triad::gltf {

/// What a node, or an animation in its stead, says of its transform and its mesh's morph targets.
struct NodePose {
    std::optional<dvec3> translation, scale;
    std::optional<dquat> rotation;
    std::vector<double> weights;  ///< of morph targets; empty: not said
};

/// Poses by the index of their node; rotations at unit length.
using Pose = std::map<int, NodePose>;

struct Node {
    /// Attributes by their names: indices of accessors.
    using Instancing = std::map<std::string, int>;

    std::string name;
    int mesh = -1, skin = -1, camera = -1, light = -1;  ///< -1: none
    bool visible = true;
    std::vector<int> children;
    std::vector<double> matrix;          ///< empty: none
    NodePose pose;                       ///< as the file says; the rotation of any length
    std::vector<Instancing> instancing;  ///< of EXT_mesh_gpu_instancing; empty: it does not have it
};

/// Moves the nodes out of a document that check_document() has passed. A file may have millions: they are
/// read from the document and not by tinygltf, whose nodes take several times as much, and every node's part
/// of the document is freed when it is read.
std::vector<Node> take_nodes(nlohmann::json& document);

dmat4 translate_rotate_scale(const dvec3& translation, const dquat& rotation, const dvec3& scale);

/// True when the matrix can be inverted with some accuracy left.
bool is_invertible(const dmat4& m);

/// `q` at unit length. Throws Error(scene) that names `what` when it has none.
dquat unit_quaternion(const dquat& q, const std::string& what);

}  // namespace triad::gltf
