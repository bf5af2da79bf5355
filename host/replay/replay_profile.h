#pragma once
/// A profile of replayed work, of which triad-replay makes the tables, the JSON and the page that triad
/// profile makes.
#include "profile/profile.h"
#include "replay/replayer.h"

namespace triad {

/// So many runs of all the work.
Profile profile_of(Replayer& replayer, unsigned runs, const LocalSizes& sizes = {});

/// Of launch `place` alone, so often.
Profile profile_alone(Replayer& replayer, std::size_t place, unsigned times);

/// Measures the device's roof, and adds what the capture says that was counted; nothing where it says
/// nothing.
void add_roof(Profile& profile, const Replayer& replayer);

}  // namespace triad
