#include "bvh/collapse.h"

#include <algorithm>

namespace triad::bvh {

CheapestCollapse::CheapestCollapse(const std::vector<BinaryNode>& nodes)
    : nodes_(nodes), plans_(nodes.size()) {
    for (std::size_t n = nodes.size(); n-- > 0;) plan(n);
}

int CheapestCollapse::children(std::uint32_t node, Children& children) const {
    int count = 0;
    distribute(node, BVH_WIDTH, children, count);
    return count;
}

void CheapestCollapse::plan(std::size_t n) {
    Plan& p = plans_[n];
    std::fill(std::begin(p.left), std::end(p.left), std::uint8_t(0));
    if (nodes_[n].count) {
        std::fill(std::begin(p.cost), std::end(p.cost), 0.0f);
        return;
    }
    const Plan &l = plans_[n + 1], &r = plans_[nodes_[n].right_or_first];
    // One slot for the left child where no cost tells: infinite areas are never less than each other.
    const auto best = [&](int slots) {
        const auto cost_of = [&](int k) { return l.cost[k - 1] + r.cost[slots - k - 1]; };
        int left = 1;
        float cost = cost_of(1);
        for (int k = 2; k < slots; ++k)
            if (const float c = cost_of(k); c < cost) cost = c, left = k;
        p.left[slots - 1] = std::uint8_t(left);
        return cost;
    };
    p.cost[0] = nodes_[n].box.half_area() + best(BVH_WIDTH);
    for (int slots = 2; slots < BVH_WIDTH; ++slots) {
        p.cost[slots - 1] = best(slots);
        if (p.cost[slots - 1] < p.cost[slots - 2]) continue;
        p.cost[slots - 1] = p.cost[slots - 2];
        p.left[slots - 1] = 0;
    }
}

void CheapestCollapse::distribute(std::uint32_t node, int slots, Children& children, int& count) const {
    const Plan& p = plans_[node];
    while (slots > 1 && slots < BVH_WIDTH && p.left[slots - 1] == 0) --slots;
    if (slots == 1 || nodes_[node].count) {
        children[std::size_t(count++)] = node;
        return;
    }
    const int left = p.left[slots - 1];
    distribute(node + 1, left, children, count);
    distribute(nodes_[node].right_or_first, slots - left, children, count);
}

LowestCollapse::LowestCollapse(const std::vector<BinaryNode>& nodes)
    : nodes_(nodes), heights_(nodes.size(), 0) {
    for (std::size_t n = nodes.size(); n-- > 0;)
        if (!nodes[n].count)
            heights_[n] = std::uint8_t(1 + std::max(heights_[n + 1], heights_[nodes[n].right_or_first]));
}

int LowestCollapse::children(std::uint32_t node, Children& children) const {
    int count = 1;
    children[0] = node;
    while (count < BVH_WIDTH) {
        const auto highest = std::max_element(children.begin(), children.begin() + count,
                                              [&](auto a, auto b) { return heights_[a] < heights_[b]; });
        if (heights_[*highest] == 0) break;
        children[std::size_t(count++)] = nodes_[*highest].right_or_first;
        *highest += 1;
    }
    return count;
}

unsigned wide_depth(const std::vector<BinaryNode>& nodes, const Collapse& collapse, std::uint32_t node) {
    if (nodes[node].count) return 0;
    Collapse::Children children;
    const int count = collapse.children(node, children);
    unsigned depth = 0;
    for (int i = 0; i < count; ++i)
        depth = std::max(depth, wide_depth(nodes, collapse, children[std::size_t(i)]));
    return depth + 1;
}

}  // namespace triad::bvh
