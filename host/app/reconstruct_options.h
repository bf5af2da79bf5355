#pragma once
/// --reconstruct and what goes with it, for `triad render` and `triad resolve`.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "render/reconstruction.h"

namespace triad {

struct ReconstructOptions {
    std::string method, panel;
    std::optional<uvec2> bins;
    std::optional<PixelFilter> filter;
    std::optional<double> ppd, distance, pitch;
    unsigned refine_steps = 8;

    /// Whether anything was asked for beyond bins.
    bool asked() const { return !method.empty() || !panel.empty() || filter.has_value(); }
    /// The method, with its taps. `film_bins`: of what there is, where --bins names none. Throws
    /// Error(usage).
    Reconstruction make(std::optional<uvec2> film_bins = {}) const;
};

/// Declares --reconstruct, --bins, --filter, --panel, --ppd, --distance, --pitch and --refine.
void declare(CLI::App& command, ReconstructOptions& options);

}  // namespace triad
