#pragma once
/// An exposure for a picture whose light is not known beforehand.
#include <cstddef>
#include <span>

#include "scene/film.h"

namespace triad {

/// EV, in tenths, by which the geometric mean of the luminance of what is in view becomes a mid grey of 0.18
/// (Reinhard et al. 2002, "Photographic tone reproduction for digital images", eq. 1). The mean is of blocks
/// of 8x8 pixels, since single ones are noise at few samples, weighted by how much of each is covered; blocks
/// darker than 1/64 of the mean luminance count as that, so that the night around a lamp does not decide. 0
/// where nothing is seen or nothing shines. Within -64 to 64.
double automatic_exposure(const Film& film);
/// The same of scene-linear RGBA with alpha premultiplied, `width` pixels in a row.
double automatic_exposure(std::span<const float> rgba, std::size_t width);

}  // namespace triad
