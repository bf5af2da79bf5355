#pragma once
/// The nodes of a file in a pose: the transforms that they give.
#include <map>
#include <vector>

#include "base/math.h"
#include "io/gltf_file.h"

namespace triad::gltf {

class PosedNodes {
  public:
    PosedNodes(File& file, Pose pose);

    /// From the node's space to its scene's. Throws Error(scene) that names a node on the way.
    dmat4 to_world(std::size_t node);
    /// Of the morph targets of the node's mesh: as posed, else the node's own, else the mesh's. Empty where
    /// all are zero.
    std::vector<double> weights(std::size_t node) const;

  private:
    dmat4 local_transform(std::size_t node);

    File& file_;
    Pose pose_;
    std::vector<int> parents_;               ///< -1: none
    std::map<std::size_t, dmat4> to_world_;  ///< of nodes with children
};

}  // namespace triad::gltf
