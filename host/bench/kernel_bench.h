#pragma once
/// What one evaluation of each function costs in a kernel of its own, where compilers may vectorise across
/// items: camera, random numbers, BSDFs, environment, lights, textures, alpha.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "device/device.h"
#include "metric/repetitions.h"

namespace triad {

/// How a launch is cut into work-items.
struct KernelBenchShape {
    std::size_t local_size;
    unsigned run;  ///< items that a work-item takes one after the other: TRIAD_RUN
};

struct KernelBenchPlan {
    std::uint32_t items = 1 << 16;  ///< of a launch; one item is one evaluation
    unsigned rounds = 9;
    std::vector<KernelBenchShape> shapes = {{1, 1}, {64, 1}, {1, 256}};
};

struct KernelSpeed {
    std::string kernel;  ///< "bsdf_sample_metal"
    std::uint32_t items = 0;
    KernelBenchShape shape;
    Estimate ns_per_item;  ///< median over the rounds; all cores that the device has together
};

/// Times all kernels whose names hold `filter`, in every shape; they take turns. Before anything is timed,
/// every kernel must give the bits of the same text compiled for lanes within an item, one item at a
/// time; else Error(comparison), which names it.
std::vector<KernelSpeed> measure_kernels(Device& device, const KernelBenchPlan& plan,
                                         const std::string& filter = {});

}  // namespace triad
