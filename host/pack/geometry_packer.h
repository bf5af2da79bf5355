#pragma once
/// The vertices and triangles of meshes as kernels read them.
#include <optional>
#include <unordered_map>
#include <vector>

#include "pack/pack.h"

namespace triad {

class GeometryPacker {
  public:
    /// `eye` in the packed world; none: nothing is refined.
    GeometryPacker(const Scene& scene, PackedScene& out, const std::optional<dvec3>& eye);

    /// Appends the mesh, transformed into the world, and its triangles for the tree builder.
    void add_placed(const Mesh& mesh, const dmat4& to_world, std::vector<BvhTriangle>& tree);
    /// The same in the mesh's own space, for instances to share.
    void add_shared(const Mesh& mesh, std::vector<BvhTriangle>& tree);

  private:
    /// Where a primitive's attributes that do not depend on the placement lie: shared by all its uses.
    struct Shared {
        std::uint32_t uv[2], colour;
    };

    Shared store(const Primitive& p);
    Shared share(const Primitive& p);
    /// `position`: of p's vertices in the space of the tree, which `m` leads to.
    void add(const Primitive& p, const Shared& shared, const std::vector<dvec3>& position, const dmat4& m,
             std::vector<BvhTriangle>& tree);

    const Scene& scene_;
    PackedScene& out_;
    const std::optional<dvec3> eye_;
    const dvec3 reach_;
    std::unordered_map<const Primitive*, Shared> shared_;
};

}  // namespace triad
