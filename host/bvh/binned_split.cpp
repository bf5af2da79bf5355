#include "bvh/binned_split.h"

#include <array>

namespace triad::bvh {

constexpr float infinity = std::numeric_limits<float>::infinity();

Split best_split(const Bins& bins, std::uint32_t unit) {
    const auto cost = [unit](const Bin& b) { return b.box.half_area() * float((b.count + unit - 1) / unit); };
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        std::array<float, bin_count> right_cost;
        Bin right, left;
        for (int i = bin_count; --i > 0;) {
            right.box.add(bins.bin[axis][i].box);
            right.count += bins.bin[axis][i].count;
            right_cost[std::size_t(i)] = right.count ? cost(right) : infinity;
        }
        for (int i = 1; i < bin_count; ++i) {
            left.box.add(bins.bin[axis][i - 1].box);
            left.count += bins.bin[axis][i - 1].count;
            const float total = left.count ? cost(left) + right_cost[std::size_t(i)] : infinity;
            if (total < best.cost) best = {total, axis, i};
        }
    }
    return best;
}

}  // namespace triad::bvh
