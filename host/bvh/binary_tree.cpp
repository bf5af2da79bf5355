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
constexpr std::size_t task_size = 1u << 12;      ///< ranges below it become one task,
constexpr std::size_t most_tasks = 64;           ///< or below one of so many parts of the whole

/// Levels of inner nodes that a balanced tree over `count` references needs.
unsigned balanced_height(std::size_t count) { return count <= 1 ? 0 : unsigned(std::bit_width(count - 1)); }

/// body(result, reference) over the range, in parallel when it is long. Sums of integers, minima and maxima
/// only: the order changes nothing.
template <class T, class Body>
T fold(std::span<const Reference> range, const Body& body) {
    T result;
    if (range.size() < parallel_size) {
        for (const Reference& r : range) body(result, WideReference(r));
        return result;
    }
    constexpr std::size_t grain = parallel_size / 4;
    std::vector<T> parts((range.size() + grain - 1) / grain);
    parallel_for(range.size(), grain, [&](std::size_t begin, std::size_t end) {
        T part;
        for (std::size_t i = begin; i < end; ++i) body(part, WideReference(range[i]));
        parts[begin / grain] = part;
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

/// True where no two boxes are equal: no triangles are, then.
bool all_differ(std::span<const Reference> references) {
    for (std::size_t i = 0; i < references.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (references[i].box == references[j].box) return false;
    return true;
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
        RangeBounds bounds;
        std::uint32_t size() const { return end - begin; }
    };
    /// What became of a range: a leaf, or two ranges.
    struct Division {
        bool leaf;
        Range left, right;  ///< left is the range of a leaf
    };
    /// A node of the top of the tree: a leaf of it is a task.
    struct TopNode {
        Box box;
        std::uint32_t left, right, task;
    };

    std::span<const Reference> references(Range range) const;
    RangeBounds bounds_of(Range range) const;
    Division divide(Range range) const;
    Division partition(Range range, const Binning& binning, Split split) const;
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
    if (range.size() <= leaf_size && all_differ(references(range))) return range;
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

std::span<const Reference> Builder::references(Range range) const {
    return std::span(references_).subspan(range.begin, range.size());
}

RangeBounds Builder::bounds_of(Range range) const {
    return fold<RangeBounds>(references(range),
                             [](RangeBounds& result, const WideReference& r) { result.add(r); });
}

/// Moves those to the front of the range that `split` puts left.
Builder::Division Builder::partition(Range range, const Binning& binning, Split split) const {
    Reference* const all = references_.data();
    std::uint32_t left = range.begin, right = range.end;
    RangeBounds below, above;
    while (true) {
        for (; left < right; ++left) {
            const WideReference r(all[left]);
            if (binning(r)[split.axis] >= split.bin) break;
            below.add(r);
        }
        for (; left < right; --right) {
            const WideReference r(all[right - 1]);
            if (binning(r)[split.axis] < split.bin) break;
            above.add(r);
        }
        if (left == right) break;
        std::swap(all[left], all[right - 1]);
    }
    return {false, {range.begin, left, range.levels - 1, below}, {left, range.end, range.levels - 1, above}};
}

Builder::Division Builder::divide(Range range) const {
    if (is_leaf(range)) return {true, without_duplicates(range), {}};
    if (range.levels > balanced_height(range.size())) {
        const Binning binning(range.bounds.centres, range.size());
        const Split split = best_split(
            fold<Bins>(references(range), [&](Bins& bins, const WideReference& r) { bins.add(binning, r); }),
            binning.count, unit_);
        if (split.cost < std::numeric_limits<float>::infinity()) return partition(range, binning, split);
    }
    // One centre for all, or no levels left to choose: halves. Equal triangles have had equal centres and so
    // are together up to here; they must be thrown out before halving could part them.
    range = without_duplicates(range);
    if (is_leaf(range)) return {true, range, {}};
    int axis = 0;
    const Float4 size = range.bounds.centres.hi - range.bounds.centres.lo;
    for (int a = 1; a < 3; ++a)
        if (size[a] > size[axis]) axis = a;
    const std::uint32_t middle = range.begin + range.size() / 2;
    std::stable_sort(references_.begin() + range.begin, references_.begin() + range.end,
                     [&](const Reference& a, const Reference& b) {
                         return WideReference(a).doubled_centre()[axis] <
                                WideReference(b).doubled_centre()[axis];
                     });
    Division halves{
        false, {range.begin, middle, range.levels - 1, {}}, {middle, range.end, range.levels - 1, {}}};
    for (Range* half : {&halves.left, &halves.right}) half->bounds = bounds_of(*half);
    return halves;
}

void Builder::build_range(Range range, std::vector<BinaryNode>& nodes) const {
    const Division division = divide(range);
    const std::size_t node = nodes.size();
    nodes.push_back({range.bounds.box.box(), division.left.begin, division.leaf ? division.left.size() : 0});
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
        {{0, count, std::max(max_height, balanced_height(count)), {}}, 0}};
    open[0].first.bounds = bounds_of(open[0].first);
    std::vector<Range> tasks;
    while (!open.empty()) {
        const auto [range, node] = open.back();
        open.pop_back();
        if (range.size() > std::max<std::size_t>(task_size, count / most_tasks)) {
            const Division division = divide(range);
            if (!division.leaf) {
                const auto child = std::uint32_t(top.size());
                top[node] = {range.bounds.box.box(), child, child + 1, 0};
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
