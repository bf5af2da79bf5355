#pragma once
/// What kernels must do for the work that they are given: bytes, operations and dependent reads, by formulas
/// over what an instrumented program counted (trace/work_counter.h).
#include <cstdint>
#include <optional>
#include <string>

#include "bvh/bvh.h"
#include "trace/work_counter.h"

namespace triad {

/// Of all that a kernel did. Bytes are those that the algorithm touches, whichever cache they come from.
struct KernelCost {
    std::string unit;  ///< "sample", "ray", "vertex"
    double units = 0;
    double bytes = 0;
    double flops = 0;       ///< of boxes and triangles alone: shading is not counted
    double gathers = 0;     ///< nodes, leaves and vertices: each is known only when the one before was read
    bool is_whole = false;  ///< flops are all there are: the kernel only walks trees
};

/// Of a kernel that followed `samples` samples in all, whose work was counted on others of the same picture;
/// none for kernels whose cost no formula says.
std::optional<KernelCost> cost_of(const std::string& kernel, const WorkCounts& counts, BvhFormat format,
                                  double samples);

}  // namespace triad
