#pragma once
/// Where a range of references is best divided: the surface-area heuristic over bins of their centres.
#include <limits>

#include "bvh/binary_tree.h"

namespace triad::bvh {

constexpr int bin_count = 16;

inline float doubled_centre(const Reference& r, int axis) { return r.box.lo[axis] + r.box.hi[axis]; }

/// Bounds of boxes, and of their doubled centres.
struct RangeBounds {
    Box box, centres;
    void add(const Reference& r) {
        Box centre;
        for (int a = 0; a < 3; ++a) centre.lo[a] = centre.hi[a] = doubled_centre(r, a);
        box.add(r.box), centres.add(centre);
    }
    void add(const RangeBounds& other) { box.add(other.box), centres.add(other.centres); }
};

/// Which bin a centre falls into.
struct Binning {
    float origin[3], scale[3];

    explicit Binning(const Box& centres) {
        for (int a = 0; a < 3; ++a) {
            origin[a] = centres.lo[a];
            scale[a] = bin_count * 0.9999f / (centres.hi[a] - centres.lo[a]);
            if (!(scale[a] < 1e30f)) scale[a] = 0.0f;  // no extent along this axis: one bin
        }
    }
    int operator()(const Reference& r, int axis) const {
        return int((doubled_centre(r, axis) - origin[axis]) * scale[axis]);
    }
};

struct Bin {
    Box box;
    std::uint32_t count = 0;
};

struct Bins {
    Bin bin[3][bin_count];
    void add(const Bins& other) {
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < bin_count; ++i) {
                bin[a][i].box.add(other.bin[a][i].box);
                bin[a][i].count += other.bin[a][i].count;
            }
    }
};

struct Split {
    float cost = std::numeric_limits<float>::infinity();
    int axis = 0, bin = 0;  ///< bins below `bin` go left; of infinite cost: there is none
};

/// The surface-area heuristic over all borders of bins: half area times leaves of `unit`, left plus right.
Split best_split(const Bins& bins, std::uint32_t unit);

}  // namespace triad::bvh
