#pragma once
/// Renders a picture several times and takes what its device did for a profile.
#include <cstdint>
#include <functional>

#include "profile/profile.h"
#include "render/renderer.h"

namespace triad {

/// Renders the goal's samples so many times, each from an empty film and with a seed of its own, after a run
/// that warms up with this one. The renderer's only device must have a profiling queue. report(done, all) is
/// called after each run and returns false to stop: what there is then is the profile. Nothing is in it of
/// work, tiles and peaks.
Profile profile_runs(Renderer& renderer, const RenderGoal& goal, std::uint32_t seed, unsigned runs,
                     const std::function<bool(unsigned, unsigned)>& report);

/// The same, with work counted, tiles timed and peaks measured after the runs.
Profile profile(Renderer& renderer, const RenderGoal& goal, std::uint32_t seed, unsigned runs,
                const std::function<bool(unsigned, unsigned)>& report);

}  // namespace triad
