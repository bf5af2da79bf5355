#include "bvh/collapse.h"

#include <algorithm>

namespace triad::bvh {

Collapse::Collapse(const std::vector<BinaryNode>& nodes, int width)
    : nodes_(nodes), width_(width), plans_(nodes.size()), waiting_(nodes.size()), heights_(nodes.size()) {
    if (!nodes.empty()) plan(0);
}

int Collapse::children(std::uint32_t node, unsigned room, Children& children) const {
    int count = 0;
    distribute(node, width_, children, count);
    if (waiting_[node] <= room) return count;
    unsigned highest = 0;
    for (int i = 0; i < count; ++i) highest = std::max<unsigned>(highest, heights_[children[std::size_t(i)]]);
    if (unsigned(count) - 1 + highest <= room) return count;
    children[0] = node + 1, children[1] = nodes_[node].right_or_first;
    return 2;
}

Collapse::Costs Collapse::plan(std::uint32_t node) {
    if (nodes_[node].count) return {};
    const std::uint32_t right = nodes_[node].right_or_first;
    const Costs left_costs = plan(node + 1), costs = plan(node, left_costs, plan(right));
    Children children;
    int count = 0;
    distribute(node, width_, children, count);
    for (int i = 0; i < count; ++i)
        waiting_[node] = std::max(waiting_[node], waiting_[children[std::size_t(i)]]);
    waiting_[node] = std::uint16_t(waiting_[node] + count - 1);
    heights_[node] = std::uint8_t(1 + std::max(heights_[node + 1], heights_[right]));
    return costs;
}

Collapse::Costs Collapse::plan(std::uint32_t node, const Costs& l, const Costs& r) {
    Plan& p = plans_[node];
    Costs costs{};
    // One slot for the left child where no cost tells: infinite areas are never less than each other.
    const auto best = [&](int slots) {
        const auto cost_of = [&](int k) { return l[std::size_t(k - 1)] + r[std::size_t(slots - k - 1)]; };
        int left = 1;
        float cost = cost_of(1);
        for (int k = 2; k < slots; ++k)
            if (const float c = cost_of(k); c < cost) cost = c, left = k;
        p[std::size_t(slots - 1)] = std::uint8_t(left);
        return cost;
    };
    costs[0] = nodes_[node].box.half_area() + best(width_);
    for (std::size_t slots = 2; slots < std::size_t(width_); ++slots) {
        costs[slots - 1] = best(int(slots));
        if (costs[slots - 1] < costs[slots - 2]) continue;
        costs[slots - 1] = costs[slots - 2];
        p[slots - 1] = 0;
    }
    return costs;
}

void Collapse::distribute(std::uint32_t node, int slots, Children& children, int& count) const {
    const Plan& p = plans_[node];
    while (slots > 1 && slots < width_ && p[std::size_t(slots - 1)] == 0) --slots;
    if (slots == 1 || nodes_[node].count) {
        children[std::size_t(count++)] = node;
        return;
    }
    const int left = p[std::size_t(slots - 1)];
    distribute(node + 1, left, children, count);
    distribute(nodes_[node].right_or_first, slots - left, children, count);
}

}  // namespace triad::bvh
