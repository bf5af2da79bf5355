/// The bounds of all that is drawn, of a million instances, too.
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace triad {
namespace {

/// Some of the points that are drawn of a mesh, near each other as files go; one that triangles share comes
/// once for each.
struct Piece {
    const std::vector<vec3>& positions;
    std::span<const unsigned> corners;
    Bounds box = {};
};

struct MeshPieces {
    std::vector<Piece> pieces;
    Bounds box;

    explicit MeshPieces(const Mesh& mesh) {
        for (const Primitive& p : mesh.primitives) {
            if (!p.triangles.empty()) add(p.positions, {&p.triangles[0].x, p.triangles.size() * 3});
            if (!p.strokes.empty()) add(p.positions, {&p.strokes[0].x, p.strokes.size() * 2});
        }
    }

  private:
    void add(const std::vector<vec3>& positions, std::span<const unsigned> corners) {
        for (; !corners.empty(); corners = corners.subspan(pieces.back().corners.size())) {
            pieces.push_back({positions, corners.first(std::min<std::size_t>(corners.size(), 192))});
            for (const unsigned corner : pieces.back().corners) pieces.back().box.add(positions[corner]);
            box.add(pieces.back().box);
        }
    }
};

/// The box around a transformed box: holds every point of the box, transformed, rounding included, since
/// each step of transform_point() is monotonic in every coordinate.
Bounds transformed(const Bounds& box, const dmat4& m) {
    Bounds all;
    for (int corner = 0; corner < 8; ++corner)
        all.add(transform_point(m, {(corner & 1 ? box.hi : box.lo).x, (corner & 2 ? box.hi : box.lo).y,
                                    (corner & 4 ? box.hi : box.lo).z}));
    return all;
}

bool is_within(const Bounds& inner, const Bounds& outer) {
    return glm::all(glm::lessThanEqual(outer.lo, inner.lo)) &&
           glm::all(glm::lessThanEqual(inner.hi, outer.hi));
}

/// The instance whose box reaches furthest in a direction.
struct Furthest {
    double reach = -std::numeric_limits<double>::infinity();
    const MeshInstance* instance = nullptr;

    void offer(double other, const MeshInstance& by) {
        if (other > reach) reach = other, instance = &by;
    }
};

}  // namespace

Bounds bounds_of(const Scene& scene) {
    const std::vector<MeshPieces> meshes(scene.meshes.begin(), scene.meshes.end());
    // Those that reach furthest come first: most others then lie within by their boxes alone.
    std::array<Furthest, 6> furthest;
    for (const MeshInstance& instance : scene.instances) {
        const Bounds box = transformed(meshes[instance.mesh].box, instance.to_world);
        for (int axis = 0; axis < 3; ++axis)
            furthest[axis].offer(box.hi[axis], instance), furthest[axis + 3].offer(-box.lo[axis], instance);
    }
    Bounds bounds;
    const auto add = [&](const MeshInstance& instance) {
        const dmat4& m = instance.to_world;
        if (is_within(transformed(meshes[instance.mesh].box, m), bounds)) return;
        for (const Piece& piece : meshes[instance.mesh].pieces)
            if (!is_within(transformed(piece.box, m), bounds))
                for (const unsigned corner : piece.corners)
                    bounds.add(transform_point(m, piece.positions[corner]));
    };
    for (const Furthest& f : furthest)
        if (f.instance) add(*f.instance);
    for (const MeshInstance& instance : scene.instances) add(instance);
    return bounds;
}

}  // namespace triad
