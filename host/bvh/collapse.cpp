#include "bvh/collapse.h"

#include <algorithm>

namespace triad::bvh {

Collapse::Collapse(const std::vector<BinaryNode>& nodes, int width)
    : nodes_(nodes), width_(width), plans_(nodes.size()), waiting_(nodes.size()), heights_(nodes.size()) {
    for (std::size_t n = nodes.size(); n-- > 0;) {
        plan(n);
        if (nodes[n].count) continue;
        Children children;
        int count = 0;
        distribute(std::uint32_t(n), width_, children, count);
        for (int i = 0; i < count; ++i)
            waiting_[n] = std::max(waiting_[n], waiting_[children[std::size_t(i)]]);
        waiting_[n] = std::uint16_t(waiting_[n] + count - 1);
        heights_[n] = std::uint8_t(1 + std::max(heights_[n + 1], heights_[nodes[n].right_or_first]));
    }
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

void Collapse::plan(std::size_t n) {
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
    p.cost[0] = nodes_[n].box.half_area() + best(width_);
    for (int slots = 2; slots < width_; ++slots) {
        p.cost[slots - 1] = best(slots);
        if (p.cost[slots - 1] < p.cost[slots - 2]) continue;
        p.cost[slots - 1] = p.cost[slots - 2];
        p.left[slots - 1] = 0;
    }
}

void Collapse::distribute(std::uint32_t node, int slots, Children& children, int& count) const {
    const Plan& p = plans_[node];
    while (slots > 1 && slots < width_ && p.left[slots - 1] == 0) --slots;
    if (slots == 1 || nodes_[node].count) {
        children[std::size_t(count++)] = node;
        return;
    }
    const int left = p.left[slots - 1];
    distribute(node + 1, left, children, count);
    distribute(nodes_[node].right_or_first, slots - left, children, count);
}

}  // namespace triad::bvh
