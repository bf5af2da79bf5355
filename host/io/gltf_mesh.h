#pragma once
#include <map>

#include "io/gltf_file.h"
#include "io/gltf_material.h"

namespace triad::gltf {

/// Meshes, converted when a node first uses them.
class Meshes {
  public:
    Meshes(File& file, Scene& scene, Materials& materials)
        : file_(file), scene_(scene), materials_(materials) {}

    /// The scene's index of this glTF mesh. Points and lines are left out with a warning.
    std::size_t use(int mesh);

  private:
    std::optional<Primitive> convert(const tinygltf::Primitive& source, const std::string& what);

    File& file_;
    Scene& scene_;
    Materials& materials_;
    std::map<int, std::size_t> meshes_;
};

}  // namespace triad::gltf
