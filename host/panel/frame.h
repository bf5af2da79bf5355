#pragma once
/// Pictures with a frame around, so that a Fourier transform, which takes them to repeat, sees no border.
#include "base/rgb_image.h"

namespace triad {

/// Pixels of frame along an axis of `size` pixels of `samples` each: enough for the eye's blur, a multiple of
/// the cell's size, and such that the whole has a fast transform.
unsigned frame_of(unsigned size, unsigned samples, unsigned cell);

/// The picture going on as in a mirror, so many of its own samples on each side.
RgbImage framed(const RgbImage& image, unsigned frame_x, unsigned frame_y);

}  // namespace triad
