#pragma once
/// Launches of a list of work, on every tracer at once, that are neither long nor short.
#include <cstdint>
#include <vector>

#include "render/film_store.h"

namespace triad {

/// Of a launch: watchdogs, cancelling and progress want short ones, overhead long ones.
constexpr double launch_seconds = 0.05;

class Launcher {
  public:
    /// `set_pixels`: of each set of the film. Both must live as long.
    Launcher(Tracers& tracers, const std::vector<std::uint32_t>& set_pixels)
        : tracers_(tracers), set_pixels_(set_pixels) {}

    /// Samples that all tracers trace in a second; 0: nothing was measured yet.
    double pace() const;
    /// Samples that a tile's work adds up to.
    std::uint64_t samples_of(const dev::TileWork& work) const;

    struct Launched {
        std::size_t tiles = 0;
        std::uint64_t samples = 0;
    };
    /// As much of work[first, ...), which the tracers were given, as takes so many seconds by the pace so
    /// far; waits for it, and measures the pace. Samples are counted from `first_sample`.
    Launched launch(const std::vector<dev::TileWork>& work, std::size_t first, std::uint64_t first_sample,
                    double seconds);

  private:
    Tracers& tracers_;
    const std::vector<std::uint32_t>& set_pixels_;
};

}  // namespace triad
