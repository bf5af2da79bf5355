#pragma once
/// What every compile-time feature costs: left out of the kernels, compiled in but not used, and used.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "device/device.h"
#include "metric/repetitions.h"

namespace triad {

struct FeatureBenchPlan {
    unsigned size = 128;         ///< pixels across and down
    std::uint64_t samples = 16;  ///< per pixel and run
    unsigned repetitions = 7;
};

/// One program on one scene.
struct FeatureRun {
    double compile_seconds = 0;
    double seconds = 0;          ///< of rendering: median of the repetitions
    double rays_per_sample = 0;  ///< a feature that is used may lengthen paths
    Estimate ratio;              ///< seconds over those with the feature left out in the same repetition
};

struct FeatureCost {
    std::string feature;  ///< "alpha test"; "all" is every feature at once, which no scene here uses
    FeatureRun left_out, unused;
    std::optional<FeatureRun> used;
    bool same_bits = false;  ///< unused made the film that left_out made
};

/// Every kernel is compiled on devices that are opened while it lives: neither our cache nor PoCL's has any.
/// For the rest of the process.
class EmptyCaches {
  public:
    EmptyCaches();

  private:
    TemporaryFolder folder_;
};

/// Measures feature after feature on generated scenes; the three programs take turns, in an order that
/// changes. `report` is called after each feature and returns false to stop there.
std::vector<FeatureCost> measure_features(Device& device, const FeatureBenchPlan& plan,
                                          const std::function<bool(const FeatureCost&)>& report);

}  // namespace triad
