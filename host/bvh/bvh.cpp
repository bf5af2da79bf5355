#include "bvh/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/freed_memory.h"
#include "base/parallel_for.h"
#include "bvh/binary_tree.h"
#include "bvh/collapse.h"
#include "bvh/nodes.h"

namespace triad {
namespace {
using namespace bvh;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Levels of inner nodes of the binary tree: no more than may wait, so that every collapse can keep to that.
constexpr unsigned most_height = BVH4_STACK;
static_assert(most_height <= BVH8_STACK);

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

/// Writes the blocks of all leaves, in the order of the tree.
class LeafWriter {
  public:
    /// `items`: of the tree's references.
    LeafWriter(const BinaryTree& tree, std::span<const std::uint32_t> items,
               std::span<const BvhTriangle> triangles, std::span<const std::uint32_t> instances,
               BvhPool& pool)
        : tree_(tree), items_(items), triangles_(triangles), instances_(instances), pool_(pool) {}

    /// dev::Bvh8Node::child of every leaf, by its place among the tree's nodes.
    std::vector<std::uint32_t> write() {
        std::vector<std::uint32_t> words(tree_.nodes.size());
        std::size_t blocks = pool_.blocks.size();
        for (std::size_t i = 0; i < words.size(); ++i)
            if (const BinaryNode& node = tree_.nodes[i]; node.count)
                words[i] = is_instance(node) ? instance_word(node) : std::uint32_t(blocks++);
        reserve_more(pool_.blocks, blocks - pool_.blocks.size());
        pool_.blocks.resize(blocks);
        parallel_for(words.size(), 1u << 14, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (const BinaryNode& node = tree_.nodes[i]; node.count && !is_instance(node))
                    words[i] |= write(node, pool_.blocks[words[i]]);
        });
        return words;
    }

  private:
    bool is_instance(const BinaryNode& leaf) const {
        return items_[leaf.right_or_first] >= triangles_.size();
    }
    std::uint32_t instance_word(const BinaryNode& leaf) const {
        return BVH_INSTANCE | instances_[items_[leaf.right_or_first] - triangles_.size()];
    }
    /// Returns the bits that stand beside the block's index.
    std::uint32_t write(const BinaryNode& leaf, dev::TriangleBlock& block) const {
        const std::uint32_t* items = items_.data() + leaf.right_or_first;
        bool opaque = true;
        for (std::uint32_t lane = 0; lane < 4; ++lane) {
            const BvhTriangle& t = triangles_[items[std::min(lane, leaf.count - 1)]];
            for (int c = 0; c < 3; ++c)
                for (int a = 0; a < 3; ++a) block.vertex[c * 3 + a][lane] = t.corner[c][a];
            block.primitive[lane] = t.primitive;
            block.geometry[lane] = t.geometry;
            opaque = opaque && t.opaque;
        }
        return BVH_LEAF | (opaque ? 0 : BVH_ALPHA);
    }

    const BinaryTree& tree_;
    std::span<const std::uint32_t> items_;
    std::span<const BvhTriangle> triangles_;
    std::span<const std::uint32_t> instances_;
    BvhPool& pool_;
};

/// Writes the nodes of one layout, depth first, so that what is walked together lies together.
template <class Node>
class NodeWriter {
  public:
    using Format = Layout<Node>;

    NodeWriter(const BinaryTree& tree, const std::vector<std::uint32_t>& leaves, float origin_reach,
               AlignedVector<Node>& nodes)
        : tree_(tree),
          leaves_(leaves),
          reach_(origin_reach),
          nodes_(nodes),
          collapse_(tree.nodes, Format::width) {
        // Half of all slots are taken, and some more: a large vector that grew would lie beside its copy.
        const std::size_t leaf_count = (tree.nodes.size() + 1) / 2;
        reserve_more(nodes_, leaf_count / (Format::width / 2) + 1);
    }

    /// The node of this binary node; none: an empty tree's.
    std::uint32_t write(std::uint32_t from = 0, unsigned room = Format::room) {
        Collapse::Children from_nodes;
        const int count = tree_.nodes.empty() ? 0 : collapse_.children(from, room, from_nodes);
        const std::span chosen(from_nodes.data(), std::size_t(count));
        const auto area = [&](std::uint32_t c) { return tree_.nodes[c].box.half_area(); };
        std::stable_sort(chosen.begin(), chosen.end(), [&](auto a, auto b) { return area(a) > area(b); });
        const auto index = std::uint32_t(nodes_.size());
        nodes_.emplace_back();
        std::array<Child, most_width> children;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const BinaryNode& child = tree_.nodes[chosen[i]];
            children[i] = {padded(child.box),
                           child.count ? leaves_[chosen[i]] : write(chosen[i], room + 1 - unsigned(count))};
        }
        write_node(std::span(children).first(chosen.size()), nodes_[index]);
        return index;
    }

  private:
    Box padded(Box box) const {
        for (int a = 0; a < 3; ++a) {
            const float pad =
                Format::padding * std::max({std::fabs(box.lo[a]), std::fabs(box.hi[a]), reach_});
            box.lo[a] -= pad;
            box.hi[a] += pad;
        }
        return box;
    }

    const BinaryTree& tree_;
    const std::vector<std::uint32_t>& leaves_;
    const float reach_;
    AlignedVector<Node>& nodes_;
    const Collapse collapse_;
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

std::vector<std::uint32_t> indices_of(const std::vector<BvhInstance>& instances) {
    std::vector<std::uint32_t> indices;
    indices.reserve(instances.size());
    for (const BvhInstance& i : instances) indices.push_back(i.instance);
    return indices;
}

std::vector<std::uint32_t> items_of(const std::vector<Reference>& references) {
    std::vector<std::uint32_t> items;
    items.reserve(references.size());
    for (const Reference& r : references) items.push_back(r.item);
    return items;
}

constexpr std::size_t many_nodes = 1 << 16;

}  // namespace

const char* name_of(BvhFormat format) { return format == BvhFormat::bvh4 ? "bvh4" : "bvh8"; }

std::optional<BvhFormat> find_bvh_format(const std::string& name) {
    for (const BvhFormat format : all_bvh_formats)
        if (name == name_of(format)) return format;
    return {};
}

BvhRoots build_bvh(std::vector<BvhTriangle> triangles, std::vector<BvhInstance> instances, float origin_reach,
                   BvhPool& pool) {
    std::vector<Reference> references = references_of(triangles, instances);
    const std::vector<std::uint32_t> placed = indices_of(std::exchange(instances, {}));
    BinaryTree tree = build_binary_tree(triangles, std::move(references), most_height);
    // A large scene's arrays are freed as soon as they are not needed: they are the most that a render takes.
    if (tree.nodes.size() > many_nodes) give_back_freed_memory();
    const std::vector<std::uint32_t> items = items_of(std::exchange(tree.references, {}));
    const std::vector<std::uint32_t> leaves = LeafWriter(tree, items, triangles, placed, pool).write();
    triangles = std::vector<BvhTriangle>();  // {} would keep the memory
    BvhRoots roots;
    roots.fill(TRIAD_NONE);
    const auto write = [&]<class Node>(BvhFormat format, AlignedVector<Node>& nodes) {
        if (pool.formats.contains(format))
            roots[std::size_t(format)] = NodeWriter<Node>(tree, leaves, origin_reach, nodes).write();
    };
    write(BvhFormat::bvh8, pool.nodes8);
    write(BvhFormat::bvh4, pool.nodes4);
    return roots;
}

}  // namespace triad
