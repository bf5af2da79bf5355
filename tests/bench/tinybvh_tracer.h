#pragma once
/// tinybvh's side of the ray benchmark: its OpenCL kernels over the same rays on the same device. They find
/// the closest hit of rays without an end; shadow rays they have none for.
#include <memory>
#include <string>
#include <vector>

#include "bench/ray_scenes.h"
#include "device/device.h"
#include "kernels/types.h"

namespace triad::bench {

class TinybvhTracer {
  public:
    /// Whether this program was built with it (TRIAD_TINYBVH, a checkout of tinybvh).
    static bool available();
    /// "cwbvh" (eight children, compressed) and "gpu4way" (four).
    static const std::vector<std::string>& layouts();

    /// `kernels`: the folder of tinybvh's traverse*.cl. Builds its best tree (BuildHQ).
    TinybvhTracer(Device& device, const RayScene& scene, const std::string& layout,
                  const std::string& kernels);
    ~TinybvhTracer();

    void set_rays(const std::vector<dev::Ray>& rays);
    /// One pass over the rays; returns when it has ended.
    void trace();
    /// Distances; of a ray that hits nothing 1e30.
    std::vector<float> distances();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace triad::bench
