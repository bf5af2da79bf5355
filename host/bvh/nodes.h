#pragma once
/// Boxes become nodes: one function for each layout of kernels/types.h.
#include <cstdint>
#include <span>

#include "bvh/binary_tree.h"
#include "kernels/types.h"

namespace triad::bvh {

/// A child of a node, its box padded.
struct Child {
    Box box;
    std::uint32_t word;  ///< dev::Bvh8Node::child
};

/// Of a layout: children of a node, and children that may wait while one tree is walked. Boxes are padded on
/// each side by `padding` of the largest coordinate in play. Worst cases in units of 2^-24 of that
/// coordinate: 13 for the slab test of Bvh8Node (one fma per plane, 2.5 ulp for the reciprocal) and 15 for
/// that of Bvh4Node (another fma for the grid's corner), 17 for the point that the triangle test finds
/// (translation, shear, interpolation); together less than 32, and less than 64.
template <class Node>
struct Layout;
template <>
struct Layout<dev::Bvh8Node> {
    static constexpr int width = 8;
    static constexpr unsigned room = BVH8_STACK;
    static constexpr float padding = 0x1p-19f;
};
template <>
struct Layout<dev::Bvh4Node> {
    static constexpr int width = 4;
    static constexpr unsigned room = BVH4_STACK;
    static constexpr float padding = 0x1p-18f;
};

/// `node`: all zero. Slots beyond the children are empty.
void write_node(std::span<const Child> children, dev::Bvh8Node& node);
void write_node(std::span<const Child> children, dev::Bvh4Node& node);

}  // namespace triad::bvh
