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

/// What each set is to hold at the end of a round.
struct Distribution {
    SetSamples samples;
    bool by_noise = false;  ///< not as many everywhere
};

/// For the least error at `mean` samples per pixel of a picture of this size whose sets hold `have`. Gives
/// whole multiples of `step` samples, never less than `have`, and something to some set.
///
/// The sum over sets of s / n at a given sum of n is least for n proportional to sqrt(s); a set's s is what
/// the others around show, so that no set decides for itself. A set gets a power of two of steps, or one and
/// a half times that, where the points of a sequence lie best. Samples go everywhere where those that go by
/// noise do not promise to lower the error faster by rays; of these they take `dearer` times as many. 0: they
/// go by noise, whatever it promises.
Distribution distribute(unsigned width, unsigned height, const SetErrors& errors, const SetSamples& have,
                        double mean, unsigned step, double dearer = 1);

}  // namespace triad
