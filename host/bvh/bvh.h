#pragma once
/// Bounding volume hierarchies in the wide layout of kernels/types.h: binned SAH on all cores, collapsed to
/// eight children.
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned_vector.h"
#include "base/math.h"
#include "kernels/types.h"

namespace triad {

/// Trees over one pool of nodes and blocks, so that instances of many meshes share the two arrays of the
/// device.
struct BvhPool {
    AlignedVector<dev::BvhNode> nodes;
    AlignedVector<dev::TriangleBlock> blocks;
};

/// What a tree is built over. Corners in the space of the tree; primitive = index into the scene's Triangle
/// array.
struct BvhTriangle {
    vec3 corner[3];
    std::uint32_t primitive;
    bool opaque = false;         ///< true: rays that hit it never ask for its coverage (alpha)
    std::uint32_t geometry = 0;  ///< index into the scene's Geometry array, carried along
};

/// A box of the top level that stands for an instance.
struct BvhInstance {
    Bounds bounds;  ///< in rebased world space
    std::uint32_t instance;
};

/// Builds one tree, appends it to `pool` and returns the index of its root node. Deterministic, whatever the
/// number of threads. Exact duplicates (the same three corners) keep the lowest primitive only.
/// `origin_reach` is the largest coordinate that a ray origin may have in this space: boxes are padded for
/// rounding at that magnitude. Precondition: corners are finite. An empty tree is a root whose children are
/// all BVH_EMPTY.
std::uint32_t build_bvh(std::span<const BvhTriangle> triangles, std::span<const BvhInstance> instances,
                        float origin_reach, BvhPool& pool);

}  // namespace triad
