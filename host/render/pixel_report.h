#pragma once
/// Everything about one pixel, from its recorded paths.
#include <string>
#include <vector>

#include "render/renderer.h"

namespace triad {

/// Means are over the samples of the pixel; samples that are not finite count as black, as in the film.
struct PixelReport {
    std::uint64_t samples = 0, not_finite = 0, rays = 0;
    dvec3 mean{0.0};
    double alpha = 0;
    dvec3 variance{0.0};  ///< of one sample
    std::uint64_t half_samples[2] = {};
    dvec3 half_means[2] = {dvec3(0.0), dvec3(0.0)};
    dvec3 mean_variance{0.0};  ///< of the mean, from the halves; zero while a half is empty

    struct Depth {
        std::uint64_t paths = 0;  ///< that have this edge
        dvec3 found{0.0}, direct{0.0};
    };
    /// [k]: what paths of k + 1 edges brought, as --max-depth counts: emission that the last edge hit, or the
    /// edge to a sampled light. The last entry also has all that is longer.
    std::vector<Depth> depths;

    struct Source {
        std::string name;
        dvec3 found{0.0}, direct{0.0};
    };
    std::vector<Source> sources;        ///< that brought something, the brightest first
    std::vector<RecordedPath> largest;  ///< by mean of their channels, the largest first

    /// What the i-th of `largest` brought to the pixel's mean: share of the sum over channels.
    double share(std::size_t i) const;
};

/// Records samples [range) of the pixel (x, y) of the crop; keeps the `keep` largest paths.
PixelReport report_pixel(Renderer& renderer, unsigned x, unsigned y, SampleRange range, std::size_t keep);

}  // namespace triad
