#include "bvh/binary_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "base/parallel_for.h"
#include "bvh/binned_split.h"

namespace triad::bvh {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::size_t parallel_size = 1u << 15;  ///< ranges above it are folded on all cores
constexpr std::size_t task_size = 1u << 12;      ///< ranges below it become one task

/// Levels of inner nodes that a balanced tree over `count` references needs.
unsigned balanced_height(std::size_t count) { return count <= 1 ? 0 : unsigned(std::bit_width(count - 1)); }

/// body(result, reference) over the range, in parallel when it is long. Sums of integers, minima and maxima
/// only: the order changes nothing.
template <class T, class Body>
T fold(std::span<const Reference> range, const Body& body) {
    T result;
    if (range.size() < parallel_size) {
        for (const Reference& r : range) body(result, r);
        return result;
    }
    constexpr std::size_t grain = parallel_size / 4;
    std::vector<T> parts((range.size() + grain - 1) / grain);
    parallel_for(range.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(parts[begin / grain], range[i]);
    });
    for (const T& part : parts) result.add(part);
    return result;
}

/// The corners as a set: sorted, with -0 made 0, so that rotation, winding and the sign of zero do not
/// matter.
using Corners = std::array<std::array<float, 3>, 3>;
Corners corners_of(const BvhTriangle& t) {
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c)
        for (int a = 0; a < 3; ++a) corners[c][std::size_t(a)] = t.corner[c][a] + 0.0f;
    std::sort(corners.begin(), corners.end());
    return corners;
}

class Builder {
  public:
    Builder(std::span<const BvhTriangle> triangles, std::vector<Reference>& references)
        : triangles_(triangles),
          references_(references),
          unit_(!references.empty() && references.back().item >= triangles.size() ? 1 : leaf_size) {}

    std::vector<BinaryNode> build(unsigned max_height);

  private:
    /// A range to be built, with the levels of inner nodes that it may have.
    struct Range {
        std::uint32_t begin, end;
        unsigned levels;
        std::uint32_t size() const { return end - begin; }
    };
    /// What became of a range: a leaf, or two ranges.
    struct Division {
        Box box;
        bool leaf;
        Range left, right;  ///< left is the range of a leaf
    };
    /// A node of the top of the tree: a leaf of it is a task.
    struct TopNode {
        Box box;
        std::uint32_t left, right, task;
    };

    Division divide(Range range) const;
    bool is_leaf(Range range) const;
    Range without_duplicates(Range range) const;
    void build_range(Range range, std::vector<BinaryNode>& nodes) const;
    void join(const std::vector<TopNode>& top, std::uint32_t node,
              std::vector<std::vector<BinaryNode>>& subtrees, std::vector<BinaryNode>& nodes) const;

    bool is_triangle(const Reference& r) const { return r.item < triangles_.size(); }

    std::span<const BvhTriangle> triangles_;
    std::vector<Reference>& references_;
    const std::uint32_t
        unit_;  ///< references that one leaf holds: 1 where there are instances (they come last)
};

bool Builder::is_leaf(Range range) const {
    if (range.size() > leaf_size) return false;
    const auto first = references_.begin() + range.begin;
    return range.size() == 1 ||
           std::all_of(first, first + range.size(), [&](const Reference& r) { return is_triangle(r); });
}

/// Sorts the range by corners, so that equal triangles are neighbours, and keeps the lowest primitive of
/// each.
Builder::Range Builder::without_duplicates(Range range) const {
    const auto first = references_.begin() + range.begin, last = references_.begin() + range.end;
    std::sort(first, last, [&](const Reference& a, const Reference& b) {
        if (!is_triangle(a) || !is_triangle(b)) return a.item < b.item;
        const Corners p = corners_of(triangles_[a.item]), q = corners_of(triangles_[b.item]);
        return p != q ? p < q : triangles_[a.item].primitive < triangles_[b.item].primitive;
    });
    const auto end = std::unique(first, last, [&](const Reference& a, const Reference& b) {
        return is_triangle(a) && is_triangle(b) &&
               corners_of(triangles_[a.item]) == corners_of(triangles_[b.item]);
    });
    range.end = std::uint32_t(end - references_.begin());
    return range;
}

Builder::Division Builder::divide(Range range) const {
    const auto references = [&] { return std::span(references_).subspan(range.begin, range.size()); };
    const RangeBounds bounds =
        fold<RangeBounds>(references(), [](RangeBounds& result, const Reference& r) { result.add(r); });
    if (is_leaf(range)) return {bounds.box, true, without_duplicates(range), {}};

    const auto parts = [&](std::uint32_t middle) {
        return Division{bounds.box,
                        false,
                        {range.begin, middle, range.levels - 1},
                        {middle, range.end, range.levels - 1}};
    };
    if (range.levels > balanced_height(range.size())) {
        const Binning binning(bounds.centres);
        const Split split = best_split(fold<Bins>(references(),
                                                  [&](Bins& bins, const Reference& r) {
                                                      for (int a = 0; a < 3; ++a) {
                                                          Bin& bin = bins.bin[a][binning(r, a)];
                                                          bin.box.add(r.box);
                                                          ++bin.count;
                                                      }
                                                  }),
                                       unit_);
        if (split.cost < std::numeric_limits<float>::infinity()) {
            const auto middle =
                std::partition(references_.begin() + range.begin, references_.begin() + range.end,
                               [&](const Reference& r) { return binning(r, split.axis) < split.bin; });
            return parts(std::uint32_t(middle - references_.begin()));
        }
    }
    // One centre for all, or no levels left to choose: halves. Equal triangles have had equal centres and so
    // are together up to here; they must be thrown out before halving could part them.
    range = without_duplicates(range);
    if (is_leaf(range)) return {bounds.box, true, range, {}};
    int axis = 0;
    const auto size = [&](int a) { return bounds.centres.hi[a] - bounds.centres.lo[a]; };
    for (int a = 1; a < 3; ++a)
        if (size(a) > size(axis)) axis = a;
    const std::uint32_t middle = range.begin + range.size() / 2;
    std::stable_sort(references_.begin() + range.begin, references_.begin() + range.end,
                     [&](const Reference& a, const Reference& b) {
                         return doubled_centre(a, axis) < doubled_centre(b, axis);
                     });
    return parts(middle);
}

void Builder::build_range(Range range, std::vector<BinaryNode>& nodes) const {
    const Division division = divide(range);
    const std::size_t node = nodes.size();
    nodes.push_back({division.box, division.left.begin, division.leaf ? division.left.size() : 0});
    if (division.leaf) return;
    build_range(division.left, nodes);
    nodes[node].right_or_first = std::uint32_t(nodes.size());
    build_range(division.right, nodes);
}

/// Appends the top from `node` on, with the subtrees of its tasks, depth first. A subtree is freed when it is
/// in its place.
void Builder::join(const std::vector<TopNode>& top, std::uint32_t node,
                   std::vector<std::vector<BinaryNode>>& subtrees, std::vector<BinaryNode>& nodes) const {
    const TopNode& from = top[node];
    const auto start = std::uint32_t(nodes.size());
    if (from.left == 0) {  // the root is nobody's child
        for (BinaryNode n : subtrees[from.task]) {
            if (n.count == 0) n.right_or_first += start;
            nodes.push_back(n);
        }
        subtrees[from.task] = std::vector<BinaryNode>();  // {} would keep the memory
        return;
    }
    nodes.push_back({from.box, 0, 0});
    join(top, from.left, subtrees, nodes);
    nodes[start].right_or_first = std::uint32_t(nodes.size());
    join(top, from.right, subtrees, nodes);
}

std::vector<BinaryNode> Builder::build(unsigned max_height) {
    const auto count = std::uint32_t(references_.size());
    std::vector<BinaryNode> nodes;
    if (count == 0) return nodes;
    // The top, range by range, each on all cores, down to ranges that are worth a task.
    std::vector<TopNode> top{{}};
    std::vector<std::pair<Range, std::uint32_t>> open{
        {{0, count, std::max(max_height, balanced_height(count))}, 0}};
    std::vector<Range> tasks;
    while (!open.empty()) {
        const auto [range, node] = open.back();
        open.pop_back();
        if (range.size() > task_size) {
            const Division division = divide(range);
            if (!division.leaf) {
                const auto child = std::uint32_t(top.size());
                top[node] = {division.box, child, child + 1, 0};
                top.resize(top.size() + 2);
                open.push_back({division.left, child});
                open.push_back({division.right, child + 1});
                continue;
            }
        }
        top[node].task = std::uint32_t(tasks.size());
        tasks.push_back(range);
    }
    std::vector<std::vector<BinaryNode>> subtrees(tasks.size());
    parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) build_range(tasks[i], subtrees[i]);
    });
    nodes.reserve(std::accumulate(subtrees.begin(), subtrees.end(), top.size(),
                                  [](std::size_t sum, const auto& subtree) { return sum + subtree.size(); }));
    join(top, 0, subtrees, nodes);
    return nodes;
}

}  // namespace

BinaryTree build_binary_tree(std::span<const BvhTriangle> triangles, std::vector<Reference> references,
                             unsigned max_height) {
    BinaryTree tree;
    tree.references = std::move(references);
    tree.nodes = Builder(triangles, tree.references).build(max_height);
    return tree;
}

}  // namespace triad::bvh
