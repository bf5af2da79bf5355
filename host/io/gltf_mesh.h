#pragma once
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "io/gltf_deform.h"
#include "io/gltf_file.h"
#include "io/gltf_material.h"

namespace triad::gltf {

/// Meshes, converted when a node first uses them.
class Meshes {
  public:
    /// `variant`: of the materials; -1: none.
    Meshes(File& file, Scene& scene, Materials& materials, int variant)
        : file_(file), scene_(scene), materials_(materials), variant_(variant) {}

    /// The scene's index of this glTF mesh, so deformed: nodes of one pose share it. `skin`: the glTF's index
    /// of the one in `deformation`; -1: none. Points and lines become strokes.
    std::size_t use(int mesh, int skin, const Deformation& deformation);

  private:
    std::optional<Primitive> convert(const tinygltf::Primitive& primitive, const Deformation& deformation,
                                     const std::string& what);

    File& file_;
    Scene& scene_;
    Materials& materials_;
    int variant_;
    std::map<std::tuple<int, int, std::vector<double>>, std::size_t> meshes_;
};

}  // namespace triad::gltf
