#include "bvh/bvh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/parallel_for.h"
#include "bvh/binary_tree.h"
#include "bvh/collapse.h"

namespace triad {
namespace {
using namespace bvh;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Of the largest coordinate in play, on each side of a box. Worst cases in units of 2^-24 of that
/// coordinate: 13 for the slab test (one fma per plane, 2.5 ulp for the reciprocal), 17 for the point that
/// the triangle test finds (translation, shear, interpolation); together less than 32.
constexpr float padding = 0x1p-19f;

/// Height of the binary tree when the collapse may choose freely, and when a collapse that takes three levels
/// at a time must keep to BVH_DEPTH.
constexpr unsigned free_height = 48, strict_height = 3 * BVH_DEPTH;

/// What the builder's sums and differences of coordinates, and bins between them, hold as floats.
constexpr float most_coordinate = 0x1p125f;

bool is_held(const Box& box) {
    for (int a = 0; a < 3; ++a)
        if (!(box.lo[a] >= -most_coordinate && box.hi[a] <= most_coordinate)) return false;
    return true;
}

/// False when a corner is no number, too.
bool has_area(const BvhTriangle& t) {
    const dvec3 a(t.corner[0]);
    const dvec3 n = glm::cross(dvec3(t.corner[1]) - a, dvec3(t.corner[2]) - a);
    return n != dvec3(0.0) && std::isfinite(n.x + n.y + n.z);
}

Box box_of(const BvhTriangle& t) {
    Box box;
    for (const vec3& c : t.corner) box.add({{c.x, c.y, c.z}, {c.x, c.y, c.z}});
    return box;
}

Box box_of(const Bounds& bounds) {
    Box box;
    for (int a = 0; a < 3; ++a) {
        box.lo[a] = std::nextafter(float(bounds.lo[a]), -infinity);
        box.hi[a] = std::nextafter(float(bounds.hi[a]), infinity);
    }
    return box;
}

/// Writes the wide tree, depth first, so that what is walked together lies together.
class Emitter {
  public:
    Emitter(const BinaryTree& tree, const Collapse& collapse, std::span<const BvhTriangle> triangles,
            std::span<const BvhInstance> instances, float origin_reach, BvhPool& pool)
        : tree_(tree),
          collapse_(collapse),
          triangles_(triangles),
          instances_(instances),
          reach_(origin_reach),
          pool_(pool) {}

    std::uint32_t emit_node(std::uint32_t from, unsigned depth) {
        assert(depth < BVH_DEPTH);
        Collapse::Children children;
        int count = 0;
        if (!tree_.nodes.empty()) count = collapse_.children(from, children);
        const auto area = [&](std::uint32_t c) { return tree_.nodes[c].box.half_area(); };
        std::stable_sort(children.begin(), children.begin() + count,
                         [&](auto a, auto b) { return area(a) > area(b); });
        const std::size_t index = pool_.nodes.size();
        dev::BvhNode node{};
        for (int i = 0; i < BVH_WIDTH; ++i) {
            node.child[i] = BVH_EMPTY;
            for (int a = 0; a < 3; ++a) {
                node.bounds[2 * a][i] = infinity;
                node.bounds[2 * a + 1][i] = -infinity;
            }
        }
        pool_.nodes.push_back(node);
        for (int i = 0; i < count; ++i) {
            const BinaryNode& child = tree_.nodes[children[std::size_t(i)]];
            for (int a = 0; a < 3; ++a) {
                const float pad =
                    padding * std::max({std::fabs(child.box.lo[a]), std::fabs(child.box.hi[a]), reach_});
                node.bounds[2 * a][i] = child.box.lo[a] - pad;
                node.bounds[2 * a + 1][i] = child.box.hi[a] + pad;
            }
            node.child[i] = child.count ? emit_leaf(child) : emit_node(children[std::size_t(i)], depth + 1);
        }
        pool_.nodes[index] = node;
        return std::uint32_t(index);
    }

  private:
    std::uint32_t emit_leaf(const BinaryNode& leaf) {
        const Reference* references = tree_.references.data() + leaf.right_or_first;
        if (references[0].item >= triangles_.size())
            return BVH_INSTANCE | instances_[references[0].item - triangles_.size()].instance;
        dev::TriangleBlock block;
        bool opaque = true;
        for (std::uint32_t lane = 0; lane < 4; ++lane) {
            const BvhTriangle& t = triangles_[references[std::min(lane, leaf.count - 1)].item];
            for (int c = 0; c < 3; ++c)
                for (int a = 0; a < 3; ++a) block.vertex[c * 3 + a][lane] = t.corner[c][a];
            block.primitive[lane] = t.primitive;
            block.geometry[lane] = t.geometry;
            opaque = opaque && t.opaque;
        }
        pool_.blocks.push_back(block);
        return BVH_LEAF | (opaque ? 0 : BVH_ALPHA) | std::uint32_t(pool_.blocks.size() - 1);
    }

    const BinaryTree& tree_;
    const Collapse& collapse_;
    std::span<const BvhTriangle> triangles_;
    std::span<const BvhInstance> instances_;
    const float reach_;
    BvhPool& pool_;
};

std::vector<Reference> references_of(std::span<const BvhTriangle> triangles,
                                     std::span<const BvhInstance> instances) {
    std::vector<Reference> references(triangles.size());
    std::vector<std::uint8_t> drawn(triangles.size());
    parallel_for(triangles.size(), 1u << 14, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            references[i] = {box_of(triangles[i]), std::uint32_t(i)};
            drawn[i] = has_area(triangles[i]) && is_held(references[i].box);
        }
    });
    std::erase_if(references, [&](const Reference& r) { return !drawn[r.item]; });
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (const Box box = box_of(instances[i].bounds); !instances[i].bounds.empty() && is_held(box))
            references.push_back({box, std::uint32_t(triangles.size() + i)});
    return references;
}

}  // namespace

std::uint32_t build_bvh(std::span<const BvhTriangle> triangles, std::span<const BvhInstance> instances,
                        float origin_reach, BvhPool& pool) {
    const std::vector<Reference> references = references_of(triangles, instances);
    const auto emit = [&](const BinaryTree& tree, const Collapse& collapse) {
        return Emitter(tree, collapse, triangles, instances, origin_reach, pool).emit_node(0, 0);
    };
    BinaryTree tree = build_binary_tree(triangles, references, free_height);
    const CheapestCollapse cheapest(tree.nodes);
    if (tree.nodes.empty() || wide_depth(tree.nodes, cheapest, 0) <= BVH_DEPTH) return emit(tree, cheapest);
    tree = build_binary_tree(triangles, references, strict_height);
    return emit(tree, LowestCollapse(tree.nodes));
}

}  // namespace triad
