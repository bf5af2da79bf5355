#pragma once
/// The error of pictures against a rendered reference, which has noise of its own: the reference is two
/// independent halves A and B, and the mean of (x - A)(x - B) is the mean of (x - r)^2 less the variance of r
/// = (A + B) / 2, without bias for a picture that depends on neither.
#include <cstdint>
#include <span>
#include <vector>

#include "base/rgb_image.h"
#include "scene/film.h"

namespace triad {

/// A reference as it is measured with.
struct Reference {
    RgbImage mean;
    std::vector<float> a, b;  ///< the halves, interleaved as the mean
    double spp = 0;
    double relmse = 0;  ///< of the mean: its own variance, by the halves
};

/// From an even film whose halves hold equally many samples. Throws std::invalid_argument otherwise.
Reference make_reference(const Film& film);

/// The scene-linear picture of a film, without its alpha.
RgbImage picture_of(const Film& film);

struct PictureError {
    /// Mean over pixels and channels of (x - r)^2, and of (x - r)^2 / (r^2 + 0.01), less what the reference's
    /// variance adds. Negative values are noise about zero.
    double mse = 0, relmse = 0;
    double relmse_trimmed = 0;    ///< without the 0.1 % of the pixels that have most of it
    std::uint64_t fireflies = 0;  ///< pixels whose mean over channels is above 20 (r + 0.01)
};

/// Throws std::invalid_argument when the sizes differ.
PictureError picture_error(std::span<const float> rgb, const Reference& reference);

/// Per pixel: mean over channels of (x - r) / sqrt(r^2 + 0.01), signed.
std::vector<float> relative_difference(std::span<const float> rgb, const Reference& reference);

}  // namespace triad
