#pragma once
#include <cstddef>
#include <functional>

namespace triad {

/// Calls body(begin, end) over [0, count) in chunks of at least `grain`, on all cores. The first exception is
/// rethrown. Chunk borders depend on nothing but count and grain, so that a body which writes per index is
/// deterministic.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Limits the threads of parallel_for (0 = all cores).
void set_host_threads(unsigned threads);
/// That parallel_for takes at most.
unsigned host_threads();

}  // namespace triad
