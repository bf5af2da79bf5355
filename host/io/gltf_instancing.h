#pragma once
/// EXT_mesh_gpu_instancing: one node that places its mesh many times.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"
#include "io/gltf_file.h"

namespace triad::gltf {

/// The instances of a node, held as their attributes.
class Instancing {
  public:
    /// `what`: the node, for messages. Throws Error(scene) for attributes of other types or different counts.
    Instancing(File& file, const Node::Instancing& attributes, const std::string& node);

    std::size_t size() const { return count_; }
    /// From instance i to its node.
    dmat4 transform(std::size_t i) const;

  private:
    std::string what_;
    std::size_t count_ = 0;
    std::vector<vec3> translations_, scales_;  ///< empty: none, as the next
    std::vector<vec4> rotations_;
};

}  // namespace triad::gltf
