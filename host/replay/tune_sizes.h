#pragma once
/// Which work-group size suits each kernel of a capture.
#include <string>
#include <vector>

#include "device/report.h"
#include "replay/replayer.h"

namespace triad {

struct SizeTiming {
    std::string kernel;
    std::size_t local = 0;
    double seconds = 0;  ///< of all its launches in a run of the work, the shortest
    bool best = false;
};

/// Runs the work with each size, `runs` times. A first size is left for another that takes 5 % less time.
/// Throws Error(comparison) where a size changes the film.
std::vector<SizeTiming> tune_sizes(Replayer& replayer, const ReplayedFilm& film, unsigned runs);

LocalSizes best_of(const std::vector<SizeTiming>& timings);

Json to_json(const std::vector<SizeTiming>& timings);
std::string table_text(const std::vector<SizeTiming>& timings);

}  // namespace triad
