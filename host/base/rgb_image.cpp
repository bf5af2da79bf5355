#include "base/rgb_image.h"

namespace triad {

RgbImage block_means(const RgbImage& image, unsigned width, unsigned height) {
    RgbImage small{image.width / width, image.height / height, {}};
    small.rgb.resize(std::size_t(small.width) * small.height * 3);
    for (unsigned y = 0; y < small.height * height; ++y)
        for (unsigned x = 0; x < small.width * width; ++x)
            for (unsigned c = 0; c < 3; ++c)
                small.rgb[(std::size_t(y / height) * small.width + x / width) * 3 + c] +=
                    image.rgb[(std::size_t(y) * image.width + x) * 3 + c] / float(width * height);
    return small;
}

}  // namespace triad
