#pragma once
/// What cases say of hits.
#include <algorithm>
#include <vector>

#include "check/measurements.h"
#include "kernels/types.h"

namespace triad::traversal_case {

inline std::size_t count_misses(const std::vector<dev::Hit>& hits) {
    return std::size_t(
        std::count_if(hits.begin(), hits.end(), [](const dev::Hit& h) { return h.primitive == TRIAD_NONE; }));
}

/// Of ray i, where b was found with lengths that are 1 / t_scale of those of a.
inline void expect_same(Check& check, const dev::Hit& a, const dev::Hit& b, float t_scale, std::size_t i) {
    check.equal(a.primitive, b.primitive, "primitive of ray ", i);
    check.equal(a.instance, b.instance, "instance of ray ", i);
    if (a.primitive == TRIAD_NONE) return;
    check.equal(a.t, b.t * t_scale, "t of ray ", i);
    check.equal(a.u, b.u, "u of ray ", i);
    check.equal(a.v, b.v, "v of ray ", i);
}

}  // namespace triad::traversal_case
