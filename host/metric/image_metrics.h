#pragma once
/// How far a picture is from a reference. Both are arrays of float values, channel by channel or interleaved
/// alike, of equal length; the mean runs over all of them, untrimmed. A value that is not finite in either
/// makes the result NaN or infinite: nothing is dropped. Throws std::invalid_argument for unequal or empty
/// arrays.
#include <span>

namespace triad {

/// Mean of |x - r|.
double mean_absolute_error(std::span<const float> picture, std::span<const float> reference);

/// Square root of the mean of (x - r)^2.
double rmse(std::span<const float> picture, std::span<const float> reference);

/// Mean of (x - r)^2 / (r^2 + 0.01) (Rousselle et al. 2011, "Adaptive Sampling and Reconstruction using
/// Greedy Error Minimization", with its epsilon).
double relmse(std::span<const float> picture, std::span<const float> reference);

/// 10 log10(peak^2 / mse), in decibels; infinite for equal pictures.
double psnr(std::span<const float> picture, std::span<const float> reference, double peak = 1.0);

}  // namespace triad
