#pragma once
/// Where a range of references is best divided: the surface-area heuristic over bins of their centres.
#include <algorithm>
#include <cstring>
#include <limits>

#include "bvh/binary_tree.h"

namespace triad::bvh {

/// Three coordinates as one vector unit holds them; the fourth number means nothing.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

/// The box of a reference in that shape.
struct WideReference {
    Float4 lo, hi;

    explicit WideReference(const Reference& r) {
        static_assert(sizeof(Reference) == 28, "what follows hi is read with it");
        Int4 bits;
        std::memcpy(&lo, r.box.lo, sizeof lo);
        std::memcpy(&bits, r.box.hi, sizeof bits);
        bits &= Int4{-1, -1, -1, 0};  // arithmetic on an item's number would be slow: it is a denormal
        std::memcpy(&hi, &bits, sizeof hi);
    }
    Float4 doubled_centre() const { return lo + hi; }
};

struct WideBox {
    Float4 lo = Float4{} + std::numeric_limits<float>::infinity();
    Float4 hi = Float4{} - std::numeric_limits<float>::infinity();

    void add(Float4 low, Float4 high) {
        lo = low < lo ? low : lo;
        hi = high > hi ? high : hi;
    }
    void add(const WideBox& b) { add(b.lo, b.hi); }
    /// As Box::half_area.
    float half_area() const {
        const Float4 d = hi - lo;
        return d[0] >= 0 ? d[0] * (d[1] + d[2]) + d[1] * d[2] : 0.0f;
    }
    Box box() const {
        Box b;
        for (int a = 0; a < 3; ++a) b.lo[a] = lo[a], b.hi[a] = hi[a];
        return b;
    }
};

/// Bounds of boxes, and of their doubled centres.
struct RangeBounds {
    WideBox box, centres;
    void add(const WideReference& r) {
        const Float4 centre = r.doubled_centre();
        box.add(r.lo, r.hi), centres.add(centre, centre);
    }
    void add(const RangeBounds& other) { box.add(other.box), centres.add(other.centres); }
};

constexpr int most_bins = 16;

/// Which bin a centre falls into, along each axis. Few references have few bins: what is gained by more is
/// little, and every one of them costs.
struct Binning {
    int count;
    Float4 origin, scale;

    Binning(const WideBox& centres, std::size_t references)
        : count(int(std::min<std::size_t>(most_bins, 4 + references / 8))), origin(centres.lo) {
        scale = (float(count) * 0.9999f) / (centres.hi - centres.lo);
        scale = scale < 1e30f ? scale : Float4{};  // no extent along this axis: one bin
    }
    Int4 operator()(const WideReference& r) const {
        return __builtin_convertvector((r.doubled_centre() - origin) * scale, Int4);
    }
};

struct Bin {
    WideBox box;
    std::uint32_t count = 0;
};

struct Bins {
    Bin bin[3][most_bins];
    void add(const Binning& binning, const WideReference& r) {
        const Int4 index = binning(r);
        for (int a = 0; a < 3; ++a) {
            Bin& b = bin[a][index[a]];
            b.box.add(r.lo, r.hi);
            ++b.count;
        }
    }
    void add(const Bins& other) {
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < most_bins; ++i) {
                bin[a][i].box.add(other.bin[a][i].box);
                bin[a][i].count += other.bin[a][i].count;
            }
    }
};

struct Split {
    float cost = std::numeric_limits<float>::infinity();
    int axis = 0, bin = 0;  ///< bins below `bin` go left; of infinite cost: there is none
};

/// The surface-area heuristic over all borders of `count` bins: half area times leaves of `unit`, a power of
/// two, left plus right.
Split best_split(const Bins& bins, int count, std::uint32_t unit);

}  // namespace triad::bvh
