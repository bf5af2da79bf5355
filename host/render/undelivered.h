#pragma once
/// What a device has taken and the host has not read yet: if the device fails, others do it again.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kernels/types.h"
#include "scene/film_sets.h"

namespace triad {

using TileWorks = std::vector<dev::TileWork>;

/// Work that a device took along.
struct LostWork {
    TileWorks work;
    std::optional<std::uint32_t>
        photon_sample;  ///< of this one alone, with its photons; counted from the work's
};

class Undelivered {
  public:
    explicit Undelivered(std::size_t tiles) : latest_(tiles) {}

    /// Joined with what there is of the tile, where it follows.
    void add(const dev::TileWork& work);
    /// A whole sample with photons.
    void add_sample(std::shared_ptr<const TileWorks> work, std::uint32_t sample);
    void clear();
    /// How many samples of each of so many sets.
    SetSamples samples(std::size_t sets) const;
    /// All of it, and clears.
    std::vector<LostWork> take();

  private:
    struct PhotonSample {
        std::shared_ptr<const TileWorks> work;
        std::uint32_t sample;
    };
    TileWorks tiles_;
    std::vector<std::size_t> latest_;  ///< of each tile: one beyond its place in tiles_; 0: none
    std::vector<PhotonSample> samples_;
};

}  // namespace triad
