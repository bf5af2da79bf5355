#pragma once
/// The sums of a film that one device adds to. Parts of several devices add up to the film.
#include <vector>

#include "device/device.h"
#include "scene/film.h"

namespace triad {

class FilmPart {
  public:
    /// Rows of tiles, from the top, so that no piece is larger than the device allows.
    struct Band {
        DeviceArray<std::int64_t> sums, half_sums;
        std::size_t first_pixel = 0, pixels = 0;
        std::size_t end_tile = 0;  ///< the first beyond it
    };

    /// For a film of this shape (its arrays are not read); not cleared. Throws Error(memory).
    FilmPart(Device& device, const Film& shape);

    void clear();
    /// Adds the part to the film's arrays, which are as large as it or empty (they begin with zeros then).
    void add_to(Film& film) const;
    /// The device goes on from this film instead of what it had.
    void load(const Film& film);

    const std::vector<Band>& bands() const { return bands_; }
    const Band& band_of_tile(std::size_t tile) const;
    const DeviceArray<std::uint32_t>& samples() const { return samples_; }    ///< of each pixel
    const DeviceArray<std::uint32_t>& counters() const { return counters_; }  ///< COUNTER_*, as pairs
    std::uint64_t bytes() const;

  private:
    Device& device_;
    std::size_t bins_ = 1;
    std::vector<Band> bands_;
    DeviceArray<std::uint32_t> samples_, counters_;
};

}  // namespace triad
