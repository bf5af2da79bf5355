#include "pack/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/math.h"

namespace triad {
namespace {

constexpr unsigned bins = 12;
constexpr unsigned levels_of_node = 3;
/// Levels of the binary tree: a way from the root fits into a trail.
constexpr unsigned deepest = 30;
constexpr std::size_t most_lights = std::size_t(1) << 28;
/// Smallest radius of a node beside that of the root: distances below count as this.
constexpr double least_radius = 1e-6;

/// Directions within `angle` of an axis.
struct Cone {
    dvec3 axis{0, 0, 1};
    double angle = -1;  ///< radians; below 0: no direction
};

/// A cone around both. (pbrt-v4, section 3.8.4)
Cone around(const Cone& a, const Cone& b) {
    if (a.angle < 0) return b;
    if (b.angle < 0) return a;
    const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
    if (std::min(between + b.angle, pi) <= a.angle) return a;
    if (std::min(between + a.angle, pi) <= b.angle) return b;
    const double angle = (a.angle + between + b.angle) / 2;
    const dvec3 across = glm::cross(a.axis, b.axis);
    if (angle >= pi || glm::dot(across, across) == 0) return {a.axis, pi};
    const double turn = angle - a.angle;
    const dvec3 side = glm::cross(glm::normalize(across), a.axis);
    return {a.axis * std::cos(turn) + side * std::sin(turn), angle};
}

/// What a group of lights sends, and from where.
struct Group {
    Bounds bounds;
    Cone axes;
    double reach = 0;  ///< the largest angle between a light's axis and its light
    double power = 0;

    void add(const Group& g) {
        bounds.add(g.bounds);
        axes = around(axes, g.axes);
        reach = std::max(reach, g.reach);
        power += g.power;
    }

    /// The heuristic's measure of directions, in [0, 4 pi].
    double directions() const {
        const double o = std::max(axes.angle, 0.0), w = std::min(o + reach, pi);
        return 2 * pi * (1 - std::cos(o)) +
               pi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
    }

    double cost() const {
        const dvec3 s = bounds.size();
        // Lights that lie in a point or on a line have an extent, too.
        const double area = s.x * s.y + s.y * s.z + s.z * s.x, length = glm::length(s);
        return power * directions() * std::max(area, 1e-3 * length * length);
    }
};

Group group_of_light(const dev::Light& l, double power) {
    const dvec3 p(l.position[0], l.position[1], l.position[2]), axis(l.axis[0], l.axis[1], l.axis[2]);
    Group g;
    g.power = power;
    g.bounds.add(p);
    g.axes = {axis, 0};
    g.reach = pi / 2;
    if (l.type == LIGHT_TRIANGLE) {
        g.bounds.add(p + dvec3(l.edge1[0], l.edge1[1], l.edge1[2]));
        g.bounds.add(p + dvec3(l.edge2[0], l.edge2[1], l.edge2[2]));
        if (l.flags & MATERIAL_DOUBLE_SIDED) g.axes.angle = pi;
    } else if (l.type == LIGHT_POINT) {
        g.axes = {dvec3(0, 0, 1), pi};
    } else {  // where the attenuation ends
        g.reach = std::acos(std::clamp(-double(l.cone_offset) / l.cone_scale, -1.0, 1.0));
    }
    return g;
}

class Builder {
  public:
    Builder(std::span<const dev::Light> lights, std::span<const double> powers) {
        tree_.trails.assign(lights.size(), TRIAD_NONE);
        for (std::size_t i = 0; i < lights.size(); ++i)
            if (has_place(lights[i]) && powers[i] > 0) {
                items_.push_back({group_of_light(lights[i], powers[i]), std::uint32_t(i)});
                all_.add(items_.back().group);
            }
    }

    LightTree build() {
        if (items_.size() >= most_lights) throw Error(Exit::memory, "The scene has more than 2^28 lights.");
        if (items_.empty()) return std::move(tree_);
        const double radius = std::max(all_.bounds.radius(), 1e-15);
        least_radius_ = least_radius * radius;
        unit_ = radius * radius;
        tree_.nodes.emplace_back();
        place(0, {0, items_.size()}, 0, 0);
        return std::move(tree_);
    }

  private:
    struct Item {
        Group group;
        std::uint32_t light;
    };
    struct Range {
        std::size_t begin, end;
        bool is_one() const { return end - begin == 1; }
    };
    std::vector<Item> items_;
    Group all_;
    LightTree tree_;
    double least_radius_ = 0;
    double unit_ = 1;  ///< of power: importances are about 1 among the lights

    /// Makes the node of a range, whose way from the root is known, and all below. A node is three levels of
    /// the binary tree.
    void place(std::size_t node, Range range, unsigned depth, std::uint32_t trail) {
        std::vector<Range> children{range};
        for (unsigned level = 0; level < levels_of_node; ++level) {
            std::vector<Range> next;
            for (const Range& r : children) {
                const std::size_t middle = r.is_one() ? r.end : split(r, depth + level);
                next.push_back({r.begin, middle});
                if (middle < r.end) next.push_back({middle, r.end});
            }
            children = std::move(next);
        }
        for (std::size_t k = 0; k < LIGHT_NODE_CHILDREN; ++k) {
            if (k >= children.size()) {
                write(tree_.nodes[node], k, Group{});
                continue;
            }
            const Range child = children[k];
            write(tree_.nodes[node], k, group_of(child));
            const std::uint32_t way = trail | std::uint32_t(k) << depth;
            if (child.is_one()) {
                tree_.nodes[node].content[k] = LIGHT_NODE_LEAF | items_[child.begin].light;
                tree_.trails[items_[child.begin].light] = way;
            } else {
                const std::size_t below = tree_.nodes.size();
                tree_.nodes[node].content[k] = std::uint32_t(below);
                tree_.nodes.emplace_back();
                place(below, child, depth + levels_of_node, way);
            }
        }
    }

    Group group_of(const Range& r) const {
        Group group;
        for (std::size_t i = r.begin; i < r.end; ++i) group.add(items_[i].group);
        return group;
    }

    void write(dev::LightNode& node, std::size_t k, const Group& g) const {
        const dvec3 centre = g.power > 0 ? g.bounds.centre() : dvec3(0.0);
        for (int axis = 0; axis < 3; ++axis)
            node.centre[axis][k] = float(centre[axis]), node.axis[axis][k] = float(g.axes.axis[axis]);
        const double rounding = 1e-6 * glm::length(centre);
        node.radius[k] = float(std::max(g.bounds.radius(), least_radius_) * (1 + 1e-5) + rounding);
        const double spread = std::clamp(g.axes.angle, 0.0, pi);
        node.spread_cosine[k] = float(std::cos(spread)), node.spread_sine[k] = float(std::sin(spread));
        node.least_cosine[k] = float(std::cos(g.reach)) - 1e-3f;
        node.power[k] = float(g.power / all_.power * unit_);
        node.content[k] = 0;
    }

    /// Divides the items at the border of bins of least cost; in halves where no border divides them, or
    /// where ways become too long.
    std::size_t split(const Range& range, unsigned depth) {
        const Group group = group_of(range);
        const auto [begin, end] = range;
        const std::size_t count = end - begin;
        int best_axis = -1;
        unsigned best_bin = 0;
        double best_cost = INFINITY;
        const dvec3 size = group.bounds.size();
        const double longest = std::max({size.x, size.y, size.z});
        Bounds centres;
        for (std::size_t i = begin; i < end; ++i) centres.add(items_[i].group.bounds.centre());
        const auto bin_of = [&](const Item& item, int axis) {
            const double at = (item.group.bounds.centre()[axis] - centres.lo[axis]) / centres.size()[axis];
            return std::min(unsigned(at * bins), bins - 1);
        };
        const bool too_long = depth + unsigned(std::bit_width(count - 1)) >= deepest;
        for (int axis = 0; axis < 3 && !too_long; ++axis) {
            if (!(centres.size()[axis] > 0)) continue;
            std::array<Group, bins> binned;
            for (std::size_t i = begin; i < end; ++i) binned[bin_of(items_[i], axis)].add(items_[i].group);
            std::array<double, bins> above{};  // cost of the bins from this one on
            Group rest;
            for (unsigned b = bins - 1; b > 0; --b) rest.add(binned[b]), above[b] = rest.cost();
            Group below;
            for (unsigned b = 0; b + 1 < bins; ++b) {
                below.add(binned[b]);
                const double cost = longest / std::max(size[axis], 1e-30) * (below.cost() + above[b + 1]);
                if (below.power > 0 && below.power < group.power && cost < best_cost)
                    best_cost = cost, best_axis = axis, best_bin = b;
            }
        }
        const auto first = items_.begin() + std::ptrdiff_t(begin),
                   last = items_.begin() + std::ptrdiff_t(end);
        if (best_axis >= 0) {
            const auto middle = std::partition(
                first, last, [&](const Item& item) { return bin_of(item, best_axis) <= best_bin; });
            if (middle != first && middle != last) return std::size_t(middle - items_.begin());
        }
        const int axis = size.x == longest ? 0 : size.y == longest ? 1 : 2;
        std::nth_element(first, first + std::ptrdiff_t(count / 2), last, [&](const Item& a, const Item& b) {
            const double x = a.group.bounds.centre()[axis], y = b.group.bounds.centre()[axis];
            return x != y ? x < y : a.light < b.light;
        });
        return begin + count / 2;
    }
};

}  // namespace

bool has_place(const dev::Light& light) {
    return light.type == LIGHT_TRIANGLE || light.type == LIGHT_POINT || light.type == LIGHT_SPOT;
}

LightTree light_tree(std::span<const dev::Light> lights, std::span<const double> powers) {
    return Builder(lights, powers).build();
}

}  // namespace triad
