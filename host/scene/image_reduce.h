#pragma once
/// Images made smaller: for scenes whose textures are larger than the memory, and for the levels of textures.
#include "scene/scene.h"

namespace triad {

/// The size of an image whose longer side has at most `longer` texels, the shorter in proportion, at least 1.
uvec2 reduced_size(unsigned width, unsigned height, unsigned longer);

/// The image at that size: every texel the mean of what it covers, of colours in linear light (alpha, and
/// images of anything else, as they are). Takes memory for a row beside the image.
Image reduced(const Image& image, unsigned longer, bool is_colour);

/// The same picture with 8 or 16 bits: there and back is the same.
Image with_bits(const Image& image, unsigned bits);

}  // namespace triad
