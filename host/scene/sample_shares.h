#pragma once
/// Which device took which samples of a film, where several of different drivers worked on it: their bits may
/// differ, so that the film's bytes follow from this.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace triad {

class SampleShares {
  public:
    /// So many samples of a set, by the device at this place of Film::devices.
    using Run = std::pair<std::uint32_t, std::uint32_t>;
    /// Of parts that say no more than which devices they had.
    static constexpr std::uint32_t several = ~0u;

    explicit SampleShares(std::size_t sets = 0) : runs_(sets) {}

    /// The next samples of a set.
    void add(std::size_t set, std::uint32_t device, std::uint32_t samples);
    /// Samples of a set that it has already are another device's.
    void set(std::size_t set, std::uint32_t first, std::uint32_t count, std::uint32_t device);
    /// A set has its first `samples` alone.
    void cut(std::size_t set, std::uint32_t samples);
    /// In the order of its samples.
    const std::vector<Run>& of(std::size_t set) const { return runs_[set]; }
    std::size_t sets() const { return runs_.size(); }
    /// Devices have other places: place i becomes to[i].
    void rename(std::span<const std::uint32_t> to);

    /// For files: how many sets have the same runs, how many runs, and these; and so on.
    std::vector<std::uint32_t> packed() const;
    /// Throws Error(scene) when these are no runs of so many sets.
    static SampleShares unpacked(std::span<const std::uint32_t> packed, std::size_t sets);

  private:
    std::vector<std::vector<Run>> runs_;
};

}  // namespace triad
