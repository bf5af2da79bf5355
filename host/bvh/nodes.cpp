#include "bvh/nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace triad::bvh {
namespace {

constexpr int grid_cells = 255;
/// Below it, planes times the inverse of a long direction would be lost below float's range.
constexpr int least_exponent = -100;

/// Exponent of the least power of two of which 255 reach from `low` to `high`.
int cell_exponent(float low, float high) {
    const double extent = double(high) - double(low);
    int exponent = std::max(least_exponent, std::ilogb(std::max(extent, 0x1p-120)) - 8);
    while (std::ldexp(grid_cells, exponent) < extent) ++exponent;
    return exponent;
}

/// What a grid can span.
Box finite(Box box) {
    constexpr float most = std::numeric_limits<float>::max();
    for (int a = 0; a < 3; ++a) {
        box.lo[a] = std::clamp(box.lo[a], -most, most);
        box.hi[a] = std::clamp(box.hi[a], -most, most);
    }
    return box;
}

}  // namespace

void write_node(std::span<const Child> children, dev::Bvh8Node& node) {
    for (std::size_t i = 0; i < 8; ++i) {
        const Box box = i < children.size() ? children[i].box : Box{};
        for (std::size_t a = 0; a < 3; ++a) {
            node.bounds[2 * a][i] = box.lo[a];
            node.bounds[2 * a + 1][i] = box.hi[a];
        }
        node.child[i] = i < children.size() ? children[i].word : BVH_EMPTY;
    }
}

void write_node(std::span<const Child> children, dev::Bvh4Node& node) {
    std::fill(std::begin(node.child), std::end(node.child), BVH_EMPTY);
    if (children.empty()) return;
    std::array<Box, 4> boxes;
    Box all;
    for (std::size_t i = 0; i < children.size(); ++i) {
        boxes[i] = finite(children[i].box);
        all.add(boxes[i]);
        node.child[i] = children[i].word;
    }
    for (int a = 0; a < 3; ++a) {
        const int exponent = cell_exponent(all.lo[a], all.hi[a]);
        node.origin[a] = all.lo[a];
        node.cells |= std::uint32_t(exponent + 127) << (8 * a);
        const auto cell = [&](float plane) {
            return std::ldexp(double(plane) - double(all.lo[a]), -exponent);
        };
        for (std::size_t i = 0; i < children.size(); ++i) {
            const auto low = std::uint32_t(std::floor(cell(boxes[i].lo[a])));
            const auto high = std::uint32_t(std::ceil(cell(boxes[i].hi[a])));
            node.bounds[2 * a] |= low << (8 * i);
            node.bounds[2 * a + 1] |= std::min<std::uint32_t>(high, grid_cells) << (8 * i);
        }
    }
}

}  // namespace triad::bvh
