#pragma once
/// References of `triad bench error`: rendered here, kept, reused, and rendered on where more samples are
/// asked for.
#include <optional>

#include "bench/error_runs.h"
#include "metric/mean_test.h"

namespace triad {

struct RenderedReference {
    Reference reference;
    RgbImage display;
    TileMeans tiles;
    double seconds = 0;  ///< spent on it now
};

/// What a case's picture is expected to be: its settings without what decides about noise alone (seed, bins,
/// sampler, roulette, instancing).
RenderSettings reference_settings(const RenderSettings& settings);

/// The name under which the reference of a scene is kept: of the scene, those settings and the kernels.
std::string reference_key(const Scene& scene, const RenderSettings& reference_settings);

/// None: stopped. What was rendered until then is kept all the same.
std::optional<RenderedReference> render_reference(const Scene& scene, const ErrorCase& like,
                                                  std::uint64_t spp, const ErrorBenchHost& host);

}  // namespace triad
