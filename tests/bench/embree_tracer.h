#pragma once
/// Embree's side of the ray benchmark: rtcIntersect1 and rtcOccluded1 over the same ray array.
#include <memory>
#include <vector>

#include "bench/ray_scenes.h"
#include "kernels/types.h"

namespace triad::bench {

class EmbreeTracer {
  public:
    static bool available();

    /// `robust` sets RTC_SCENE_FLAG_ROBUST; build quality is medium.
    EmbreeTracer(const RayScene& scene, bool robust);
    ~EmbreeTracer();

    /// Seconds of one pass over the rays, on the threads of parallel_for.
    double closest(const std::vector<dev::Ray>& rays, std::vector<dev::Hit>& hits) const;
    double occluded(const std::vector<dev::Ray>& rays, std::vector<std::uint32_t>& occluded) const;

    double build_seconds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace triad::bench
