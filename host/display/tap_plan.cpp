#include "display/tap_plan.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "panel/pixel_filter.h"

namespace triad {
namespace {

int floor_div(int a, int b) { return a / b - (a % b < 0); }
int floor_mod(int a, int b) { return a - floor_div(a, b) * b; }

/// Collects taps output by output, and fills them up to equal numbers.
class Collector {
  public:
    Collector(unsigned planes, unsigned phases) {
        sums_.planes = planes, sums_.phases = phases;
        taps_.resize(std::size_t(planes) * phases);
    }

    void add(unsigned phase, unsigned plane, std::int64_t offset, float weight) {
        if (weight == 0) return;
        if (offset != std::int32_t(offset)) throw std::logic_error("planes are too large for their taps");
        taps_[phase * sums_.planes + plane].push_back({std::int32_t(offset), weight});
    }

    PlaneSums finish() {
        std::size_t most = 1;
        for (const auto& list : taps_) most = std::max(most, list.size());
        sums_.taps = unsigned(most);
        for (const auto& list : taps_)
            for (std::size_t i = 0; i < most; ++i) {
                sums_.offsets.push_back(i < list.size() ? list[i].offset : 0);
                sums_.weights.push_back(i < list.size() ? list[i].weight : 0.0f);
            }
        return std::move(sums_);
    }

  private:
    struct Tap {
        std::int32_t offset;
        float weight;
    };
    PlaneSums sums_;
    std::vector<std::vector<Tap>> taps_;
};

void check(const TapTable& table) {
    const auto refuse = [](const char* what) {
        throw Error(Exit::usage, std::string("The tap table cannot be used: ") + what + ".");
    };
    if (table.bins_x == 0 || table.bins_y == 0 || table.cell_x == 0 || table.cell_y == 0)
        refuse("it has no bins or no pixels");
    if (table.outputs.size() != std::size_t(table.cell_x) * table.cell_y * 3)
        refuse("it must have three outputs for every pixel of the cell");
    for (const Taps& taps : table.outputs) {
        const std::size_t n = std::size_t(taps.width) * taps.height;
        if (n == 0 || n > 65536 || taps.weights.size() != n) refuse("an output has not all of its weights");
        if (!taps.cross.empty() && taps.cross.size() != 3 * n) refuse("an output has not all cross weights");
        if (taps.across.empty() != taps.down.empty() ||
            (!taps.across.empty() && (taps.across.size() != taps.width || taps.down.size() != taps.height)))
            refuse("a product of rows and columns has not all of its weights");
    }
}

}  // namespace

TapTable box_taps(unsigned bins_x, unsigned bins_y) { return filter_taps({}, bins_x, bins_y); }

TapPlan::TapPlan(const TapTable& table, bool alpha) : table_(table), channels_(alpha ? 4 : 3) {
    check(table);
    if (alpha) {
        const Taps box = box_taps(table.bins_x, table.bins_y).outputs[0];
        table_.outputs.clear();
        for (std::size_t i = 0; i < table.outputs.size(); i += 3) {
            table_.outputs.insert(table_.outputs.end(), &table.outputs[i], &table.outputs[i] + 3);
            table_.outputs.push_back(box);
        }
    }
    const int bins_x = int(table.bins_x), bins_y = int(table.bins_y), columns = bins_x * int(table.cell_x);
    for (std::size_t i = 0; i < table_.outputs.size(); ++i) {
        const Taps& taps = table_.outputs[i];
        const int first = int(i / channels_ % table.cell_x) * bins_x + taps.first_x;
        const int last = first + int(taps.width) - 1, bottom = taps.first_y + int(taps.height) - 1;
        left_ = std::max(left_, unsigned(std::max(0, -floor_div(first, columns))));
        right_ = std::max(right_, unsigned(std::max(0, floor_div(last, columns))));
        up_ = std::max(up_, unsigned(std::max(0, -floor_div(taps.first_y, bins_y))));
        down_ = std::max(down_, unsigned(std::max(0, floor_div(bottom, bins_y))));
        separable_ = separable_ && !taps.across.empty() && taps.cross.empty();
    }
}

PlaneSums TapPlan::down_sums(const PlaneShape& bins) const {
    Collector collector(channels_ * table_.cell_x * columns(), table_.cell_y);
    for (unsigned phase = 0; phase < table_.cell_y; ++phase)
        for (unsigned c = 0; c < channels_; ++c)
            for (unsigned x = 0; x < table_.cell_x; ++x)
                for (unsigned column = 0; column < columns(); ++column) {
                    const Taps& taps = of(phase, x, c);
                    for (unsigned v = 0; v < taps.height; ++v)
                        collector.add(phase, (c * table_.cell_x + x) * columns() + column,
                                      std::int64_t(c * columns() + column) * std::int64_t(bins.plane) +
                                          (taps.first_y + int(v)) * std::int64_t(bins.stride),
                                      taps.down[v]);
                }
    return collector.finish();
}

template <class Visit>
PlaneSums TapPlan::collect(Visit&& visit) const {
    Collector collector(channels_ * table_.cell_x, table_.cell_y);
    for (unsigned phase = 0; phase < table_.cell_y; ++phase)
        for (unsigned c = 0; c < channels_; ++c)
            for (unsigned x = 0; x < table_.cell_x; ++x) {
                const Taps& taps = of(phase, x, c);
                const unsigned plane = c * table_.cell_x + x;
                const int first = int(x * table_.bins_x) + taps.first_x;
                visit(c, plane, first, taps, [&](std::int64_t offset, float weight) {
                    collector.add(phase, plane, offset, weight);
                });
            }
    return collector.finish();
}

std::int64_t TapPlan::column_at(std::int64_t first_plane, int at, const PlaneShape& shape) const {
    const int columns = int(this->columns());
    return (first_plane * columns + floor_mod(at, columns)) * std::int64_t(shape.plane) +
           floor_div(at, columns);
}

PlaneSums TapPlan::across_sums(const PlaneShape& sums) const {
    return collect([&](unsigned, unsigned plane, int first, const Taps& taps, auto&& add) {
        for (unsigned u = 0; u < taps.width; ++u) add(column_at(plane, first + int(u), sums), taps.across[u]);
    });
}

PlaneSums TapPlan::sums(const PlaneShape& bins) const {
    return collect([&](unsigned c, unsigned, int first, const Taps& taps, auto&& add) {
        const std::size_t n = std::size_t(taps.width) * taps.height;
        for (unsigned from = 0; from < channels_; ++from) {
            if (from != c && (from > 2 || taps.cross.empty())) continue;
            const float* weights = from == c ? taps.weights.data() : taps.cross.data() + from * n;
            for (unsigned v = 0; v < taps.height; ++v)
                for (unsigned u = 0; u < taps.width; ++u)
                    add(column_at(from, first + int(u), bins) +
                            (taps.first_y + int(v)) * std::int64_t(bins.stride),
                        weights[v * taps.width + u]);
        }
    });
}

PlaneSums refine_sums(const RefineStencil& s, const PlaneShape& drives) {
    const int radius = int(s.radius), side = 2 * radius + 1;
    if (s.weights.size() != std::size_t(s.cell_x) * s.cell_y * 9 * side * side)
        throw Error(Exit::usage, "The stencil of the refinement cannot be used: it has not all weights.");
    Collector collector(3 * s.cell_x, s.cell_y);
    std::size_t i = 0;
    for (unsigned phase = 0; phase < s.cell_y; ++phase)
        for (unsigned x = 0; x < s.cell_x; ++x)
            for (unsigned c = 0; c < 3; ++c)
                for (int dy = -radius; dy <= radius; ++dy)
                    for (int dx = -radius; dx <= radius; ++dx)
                        for (unsigned from = 0; from < 3; ++from, ++i) {
                            const int at = int(x) + dx;
                            // Planes are counted from the output's own.
                            const auto plane = std::int64_t(from * s.cell_x) + floor_mod(at, int(s.cell_x)) -
                                               std::int64_t(c * s.cell_x + x);
                            collector.add(phase, c * s.cell_x + x,
                                          plane * std::int64_t(drives.plane) +
                                              dy * std::int64_t(drives.stride) + floor_div(at, int(s.cell_x)),
                                          s.weights[i]);
                        }
    return collector.finish();
}

}  // namespace triad
