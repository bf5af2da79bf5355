#include "bvh/binned_split.h"

#include <array>
#include <bit>

namespace triad::bvh {

constexpr float infinity = std::numeric_limits<float>::infinity();

Split best_split(const Bins& bins, int count, std::uint32_t unit) {
    const int shift = std::countr_zero(unit);
    const auto cost = [&](const Bin& b) { return b.box.half_area() * float((b.count + unit - 1) >> shift); };
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        const Bin* bin = bins.bin[axis];
        std::array<float, most_bins> right_cost;
        Bin right, left;
        for (int i = count; --i > 0;) {
            right.box.add(bin[i].box);
            right.count += bin[i].count;
            right_cost[std::size_t(i)] = right.count ? cost(right) : infinity;
        }
        for (int i = 1; i < count; ++i) {
            left.box.add(bin[i - 1].box);
            left.count += bin[i - 1].count;
            const float total = left.count ? cost(left) + right_cost[std::size_t(i)] : infinity;
            if (total < best.cost) best = {total, axis, i};
        }
    }
    return best;
}

}  // namespace triad::bvh
