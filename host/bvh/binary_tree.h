#pragma once
/// The binary tree that the wide one is collapsed from: binned SAH, Wald, "On fast construction of SAH-based
/// bounding volume hierarchies" (2007), with leaves of at most one TriangleBlock.
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bvh/bvh.h"

namespace triad::bvh {

struct Box {
    float lo[3]{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                std::numeric_limits<float>::infinity()};
    float hi[3]{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                -std::numeric_limits<float>::infinity()};

    void add(const Box& b) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = b.lo[a] < lo[a] ? b.lo[a] : lo[a];
            hi[a] = b.hi[a] > hi[a] ? b.hi[a] : hi[a];
        }
    }
    bool operator==(const Box&) const = default;
    /// Half the surface area; 0 when empty. Infinite where float cannot square the sides.
    float half_area() const {
        const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
        return x >= 0 ? x * (y + z) + y * z : 0.0f;
    }
};

/// What is sorted into the tree: items below the number of triangles are triangles, the others instances.
struct Reference {
    Box box;
    std::uint32_t item;
};

/// Nodes lie in depth-first order: the left child follows its parent. `count` is 0 for an inner node.
struct BinaryNode {
    Box box;
    std::uint32_t right_or_first;  ///< inner: the right child; leaf: the first of its references
    std::uint32_t count;
};

struct BinaryTree {
    std::vector<BinaryNode> nodes;  ///< nodes[0] is the root; empty for an empty tree
    std::vector<Reference> references;
};

/// Builds the tree over `references`, with at most `max_height` levels of inner nodes (but never fewer than a
/// balanced tree needs), in the same order whatever the number of threads. A leaf has at most four triangles,
/// or one instance. Exact duplicates among `triangles` are dropped, the lowest primitive stays.
BinaryTree build_binary_tree(std::span<const BvhTriangle> triangles, std::vector<Reference> references,
                             unsigned max_height);

}  // namespace triad::bvh
