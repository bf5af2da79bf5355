#pragma once
/// Whether a replay ends with the captured film: bit for bit, or as a device with other arithmetic may.
#include <cstdint>
#include <string>

#include "device/report.h"
#include "replay/replayer.h"

namespace triad {

/// The same samples are in both films, so that no noise is between them: paths follow each other until
/// rounding sends a few another way.
struct FilmDifference {
    bool same_bits = false;
    std::uint64_t pixels = 0, pixels_with_other_samples = 0;
    std::uint64_t bins = 0, bins_off = 0;  ///< off: a colour differs by more than bin_tolerance
    double samples_per_bin = 0;
    std::uint64_t tiles = 0, tiles_off = 0;  ///< by more than tile_tolerance
    double largest_tile = 0;                 ///< relative difference
    double bias = 0;                         ///< median of the tiles' signed relative differences
    double chance_bias = 0;                  ///< as large as this it may be by chance
    double rays = 0, captured_rays = 0;

    // The rule, which docs/capture.md explains.
    static constexpr double bin_tolerance = 0.001, tile_tolerance = 0.02;
    static constexpr double most_samples_astray = 0.02, most_tiles_off = 0.1, most_bias = 0.0005,
                            most_rays = 0.02, spare_rays = 100;

    double bins_that_may_be_off() const;  ///< a share
    double relative_rays() const { return captured_rays > 0 ? rays / captured_rays - 1 : rays > 0; }
    /// Empty: it agrees. Else a phrase for each bound that is broken.
    std::string why_not() const;
};

FilmDifference difference(const Capture& capture, const ReplayedFilm& film);

/// Whether equal bits are to be expected of the device.
bool is_captured_device(const CaptureOrigin& origin, const Device& device);

enum class VerifyRule { automatic, bits, film };

struct Verification {
    FilmDifference difference;
    bool by_bits = false;  ///< bits had to be the same
    bool ok = false;
    std::string sentence;
};
Verification judge(const Capture& capture, const Device& device, const ReplayedFilm& film, VerifyRule rule);
Json to_json(const Verification& verification);

}  // namespace triad
