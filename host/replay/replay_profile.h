#pragma once
/// A profile of replayed work, of which triad-replay makes the tables, the JSON and the page that triad
/// profile makes.
#include <optional>

#include "profile/profile.h"
#include "replay/replayer.h"

namespace triad {

/// So many runs of all the work.
Profile profile_of(Replayer& replayer, unsigned runs, const LocalSizes& sizes = {});

/// Of launch `place` alone, so often.
Profile profile_alone(Replayer& replayer, std::size_t place, unsigned times);

/// What rays took where the work was captured; none where the capture does not say. Throws Error(scene) where
/// that is damaged.
std::optional<WorkCounts> counted_work(const Capture& capture);

}  // namespace triad
