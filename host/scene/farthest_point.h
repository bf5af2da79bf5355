#pragma once
/// The point of a scene that is farthest in a direction, without looking at every vertex of every instance.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/math.h"
#include "scene/scene.h"

namespace triad {

/// Made in one pass over the triangles of every mesh, however often the mesh is placed; a search then asks
/// the boxes of instances, and in few of them those of blocks of triangles. Keeps a reference to the scene.
class FarthestPoint {
  public:
    explicit FarthestPoint(const Scene& scene);

    /// Exact, relative to origin(). Of points equally far, any, but always the same.
    dvec3 operator()(const dvec3& direction) const;

    /// Near to the scene, so that differences of coordinates far from zero keep their digits.
    const dvec3& origin() const { return origin_; }

  private:
    struct Box {
        dvec3 centre{0.0}, half{-1.0};

        Box() = default;
        explicit Box(const Bounds& b) : centre(b.centre()), half(0.5 * b.size()) {}
        double reach(const dvec3& d) const { return glm::dot(d, centre) + glm::dot(glm::abs(d), half); }
    };
    /// Some of the triangles of a primitive.
    struct Block {
        const Primitive* primitive = nullptr;
        std::size_t first = 0, count = 0;
        Box box;
    };
    struct MeshBlocks {
        std::vector<Block> blocks;
        Box box;
    };
    struct Placed {
        const MeshInstance* instance = nullptr;
        Box box;  ///< in the world, relative to the origin
    };
    struct Search;

    void add_blocks(const Scene& scene, bool all);
    void look_into(Search& search, const MeshInstance& instance) const;

    std::vector<MeshBlocks> meshes_;  ///< as in the scene
    std::vector<Placed> placed_;
    std::vector<dvec3> stroke_ends_;
    dvec3 origin_{0.0};
};

}  // namespace triad
