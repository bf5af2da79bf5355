#pragma once
/// How samples are to become pixels, as it is asked for.
#include <optional>
#include <string>

#include "base/math.h"
#include "display/reconstruction.h"

namespace triad {

struct ReconstructRequest {
    std::string method, panel;
    std::optional<uvec2> bins;
    std::optional<PixelFilter> filter;
    std::optional<double> ppd, distance, pitch;
    std::optional<unsigned> refine_steps;

    /// Whether anything was asked for beyond bins.
    bool asked() const { return !method.empty() || !panel.empty() || filter.has_value(); }
    /// The method, with its taps. `film_bins`: of what there is, where --bins names none. Throws
    /// Error(usage).
    Reconstruction make(std::optional<uvec2> film_bins = {}) const;
};

}  // namespace triad
