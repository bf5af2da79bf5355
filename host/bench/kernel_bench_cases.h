#pragma once
/// The kernels of kernel_bench.h as text.
#include <string>
#include <vector>

namespace triad {

struct KernelBenchCase {
    std::string name;     ///< "bsdf_sample_metal"
    std::string feature;  ///< the scene is that of feature_cases() which uses it
    std::string body;     ///< reads IN(k), writes OUT(k, value) of kernel_bench_outputs
};

inline constexpr unsigned kernel_bench_inputs = 14, kernel_bench_outputs = 10;

std::vector<KernelBenchCase> kernel_bench_cases();

/// The program of a case, with the kernel `measured(SCENE_PARAMETERS, in, out, triangle_count, count)`.
std::string kernel_bench_source(const KernelBenchCase& c);

}  // namespace triad
