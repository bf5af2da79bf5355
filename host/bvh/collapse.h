#pragma once
/// From two children to four or eight: which descendants of a binary node become the children of a wide node.
#include <array>
#include <cstdint>
#include <vector>

#include "bvh/binary_tree.h"

namespace triad::bvh {

constexpr int most_width = 8;

/// The cheapest collapse by the surface-area heuristic: Ylitie, Karras, Laine, "Efficient incoherent ray
/// traversal on GPUs through compressed wide BVHs" (2017), equations 3 to 7. The leaves are fixed here, so
/// that the areas of the wide nodes are all that counts. Where a walk would leave more children waiting than
/// its stack has room for, the deepest parts keep nodes of two children.
class Collapse {
  public:
    using Children = std::array<std::uint32_t, most_width>;

    /// Nodes of up to `width` children. `nodes` must live as long.
    Collapse(const std::vector<BinaryNode>& nodes, int width);

    /// Writes the children of the wide node at binary node `node` and returns how many; a leaf is its own
    /// child. `room`: children that may wait on the stack of a walk below and with `node`, which leaves room
    /// - (count - 1) to each of these. It is kept to wherever it is not less than the height of `node`.
    int children(std::uint32_t node, unsigned room, Children& children) const;

    /// Children that wait at most, below and with `node`, if nothing limits them.
    unsigned waiting(std::uint32_t node) const { return waiting_[node]; }

  private:
    /// [i - 1]: the areas of the wide nodes below when a node may take i slots of its parent (1 to width -
    /// 1).
    using Costs = std::array<float, most_width - 1>;
    /// [i - 1]: how many of i slots (2 to width) a node's left child is given, 0: it takes fewer.
    using Plan = std::array<std::uint8_t, most_width>;

    /// Plans the node and what is below it.
    Costs plan(std::uint32_t node);
    Costs plan(std::uint32_t node, const Costs& left, const Costs& right);
    void distribute(std::uint32_t node, int slots, Children& children, int& count) const;

    const std::vector<BinaryNode>& nodes_;
    const int width_;
    std::vector<Plan> plans_;
    std::vector<std::uint16_t> waiting_;
    std::vector<std::uint8_t> heights_;  ///< levels of inner nodes: as many wait where all have two children
};

}  // namespace triad::bvh
