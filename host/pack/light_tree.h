#pragma once
/// The tree that many lights are picked by: kernels/shading/light_tree.h.
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/types.h"

namespace triad {

struct LightTree {
    std::vector<dev::LightNode> nodes;  ///< the root first
    /// Of every light of the scene: bit k says which child the way from the root takes at depth k;
    /// TRIAD_NONE: it is not in the tree.
    std::vector<std::uint32_t> trails;
    std::uint32_t first_share = 0, shares = 0;  ///< of 2^31, by which light sampling comes to the tree
};

/// Whether a light of this type can be in the tree: it is somewhere.
bool has_place(const dev::Light& light);

/// Nodes and trails of the tree over the lights that have a place and a power, built from the top with the
/// surface area orientation heuristic (Conty Estevez and Kulla 2018, section 4.4). `powers`: of the lights,
/// any unit, not negative. Throws Error(memory) beyond 2^28 lights.
LightTree light_tree(std::span<const dev::Light> lights, std::span<const double> powers);

}  // namespace triad
