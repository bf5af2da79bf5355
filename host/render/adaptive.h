#pragma once
/// Adaptive sampling: where the next samples lower the error of the picture most.
///
/// Samples of a pixel that decide how many more it gets bias its mean: a pixel that has missed its bright
/// paths so far looks finished and stays too dark (Kirk and Arvo 1991, "Unbiased sampling techniques for
/// image synthesis"). Here the pixels of a tile are two sets, like the squares of a chessboard, and each set
/// is given samples by what the other set and the tiles around have shown: neighbours have alike noise but
/// independent samples.
#include <cstdint>
#include <span>
#include <vector>

#include "scene/film_sets.h"

namespace triad {

/// Of the relMSE. `errors`: error_map(film, Neighbours::own_set), which may be empty too.
SetErrors relmse_of_sets(const Film& film, std::span<const float> errors, const SetSamples& have);

/// What each set of a picture of this size should hold for the least error at `mean` samples per pixel, given
/// that it holds `have`. Gives whole multiples of `step` samples, never less than `have`, and something to
/// some set. The sum over sets of s / n at a given sum of n is least for n proportional to sqrt(s); a set's s
/// is what the others around show, so that no set decides for itself.
SetSamples distribute(unsigned width, unsigned height, const SetErrors& errors, const SetSamples& have,
                      double mean, unsigned step);

}  // namespace triad
