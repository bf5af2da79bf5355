#pragma once
/// The film of a picture, on the host: what it is called, and what the tracers' parts add up to.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pack/pack.h"
#include "scene/film.h"
#include "scene/film_sets.h"
#include "trace/tracer.h"

namespace triad {

using Tracers = std::vector<std::unique_ptr<Tracer>>;

class FilmStore {
  public:
    /// An empty film of the picture: no arrays, no ranges, no devices.
    FilmStore(const PackedScene& packed, const RenderSettings& settings);

    /// The film without its arrays, unless gather() has read them.
    const Film& film() const { return film_; }

    /// Begins again: the same picture with these settings (another seed).
    void restart(const PackedScene& packed, const RenderSettings& settings);
    void add_device(const DeviceInfo& device) { add_device(words_of(device)); }
    void add_device(const std::string& words);
    /// Its place among the film's devices, to which it was added.
    std::uint32_t place_of(const DeviceInfo& device) const;
    void set_shares(std::vector<std::uint32_t> shares) { film_.shares = std::move(shares); }
    void set_ranges(std::vector<SampleRange> ranges) { film_.ranges = std::move(ranges); }
    void set_progress(std::optional<FilmProgress> progress) { film_.progress = std::move(progress); }
    /// Reads the parts into the arrays, which are then what all tracers have found so far.
    const Film& gather(const Tracers& tracers);
    /// Adds what a tracer's part holds to the arrays. Throws where it cannot be read or is not what the
    /// tracer was to take, of each set, and has then added nothing.
    void deliver(Tracer& tracer, const SetSamples& expected);
    /// The arrays begin as those of a film that goes on.
    void begin_with(const Film& film);
    /// The film, whose arrays are then no longer here.
    Film take();
    /// Tiles of the crop lose their samples.
    void drop_tiles(const std::vector<bool>& tiles);

  private:
    Film film_;

    static std::string words_of(const DeviceInfo& device) { return device.name + ", " + device.driver; }
};

}  // namespace triad
