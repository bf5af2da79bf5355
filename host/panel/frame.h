#pragma once
/// Pictures with a frame around, so that a Fourier transform, which takes them to repeat, sees no border.
#include "base/rgb_image.h"
#include "panel/panel.h"

namespace triad {

/// Pixels of frame along an axis of `size` pixels of `samples` each: enough for the eye's blur, a multiple of
/// the cell's size, and such that the whole has a fast transform.
unsigned frame_of(unsigned size, unsigned samples, unsigned cell);

/// The picture going on as in a mirror, so many of its own samples on each side.
RgbImage framed(const RgbImage& image, unsigned frame_x, unsigned frame_y);

/// What a panel shows of a picture that repeats, `samples` per pixel, by a box of one pixel around each
/// emitter. In the frame of a reference this stands for what lies beyond the picture: mirrored drives would
/// be those of another panel, and wide blurs see their error far inside.
RgbImage boxed_drives(const Panel& panel, const RgbImage& picture, unsigned samples);

/// Puts a picture into the middle of a larger one.
void put_in_frame(const RgbImage& image, RgbImage& frame);

}  // namespace triad
