#pragma once
/// From two children to eight: which descendants of a binary node become the children of a wide node.
#include <array>
#include <cstdint>
#include <vector>

#include "bvh/binary_tree.h"

namespace triad::bvh {

class Collapse {
  public:
    using Children = std::array<std::uint32_t, BVH_WIDTH>;
    virtual ~Collapse() = default;
    /// Writes the children of the wide node at binary node `node` and returns how many; a leaf is its own
    /// child.
    virtual int children(std::uint32_t node, Children& children) const = 0;
};

/// The cheapest collapse by the surface-area heuristic: Ylitie, Karras, Laine, "Efficient incoherent ray
/// traversal on GPUs through compressed wide BVHs" (2017), equations 3 to 7. The leaves are fixed here, so
/// that the areas of the wide nodes are all that counts.
class CheapestCollapse : public Collapse {
  public:
    explicit CheapestCollapse(const std::vector<BinaryNode>& nodes);
    int children(std::uint32_t node, Children& children) const override;

  private:
    /// cost[i - 1]: the areas of the wide nodes below when the node may take i slots of its parent (1 to 7);
    /// left[i - 1]: how many of i slots (2 to 8) its left child is given, 0: it takes fewer slots.
    struct Plan {
        float cost[BVH_WIDTH - 1];
        std::uint8_t left[BVH_WIDTH];
    };
    void plan(std::size_t n);
    void distribute(std::uint32_t node, int slots, Children& children, int& count) const;

    const std::vector<BinaryNode>& nodes_;
    std::vector<Plan> plans_;
};

/// Opens the highest child until there are eight: seven openings take three whole levels away, so that a
/// binary tree of 3 n levels becomes a wide one of n.
class LowestCollapse : public Collapse {
  public:
    explicit LowestCollapse(const std::vector<BinaryNode>& nodes);
    int children(std::uint32_t node, Children& children) const override;

  private:
    const std::vector<BinaryNode>& nodes_;
    std::vector<std::uint8_t> heights_;
};

/// Levels of wide nodes below and with `node`.
unsigned wide_depth(const std::vector<BinaryNode>& nodes, const Collapse& collapse, std::uint32_t node);

}  // namespace triad::bvh
