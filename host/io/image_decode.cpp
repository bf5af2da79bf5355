/// PNG, JPEG and WebP bytes to RGBA texels.
#include <cstring>

#include "base/error.h"
#include "io/image_container.h"
#include "io/io.h"
#include "io/oiio.h"

namespace triad {
namespace {

/// One row of 1 to 4 channels to RGBA: grey is repeated, missing alpha is opaque.
template <class T>
void expand(const T* from, unsigned channels, std::size_t pixels, T* to) {
    for (std::size_t i = 0; i < pixels; ++i, from += channels, to += 4) {
        const bool grey = channels < 3;
        to[0] = from[0];
        to[1] = grey ? from[0] : from[1];
        to[2] = grey ? from[0] : from[2];
        to[3] = channels == 2 ? from[1] : channels == 4 ? from[3] : T(~T(0));
    }
}

}  // namespace

Image decode_image(const std::string& name, const std::vector<std::uint8_t>& bytes) {
    const CleanImage clean = clean_image(name, bytes);
    const char* format = clean.format == ImageFormat::png    ? "png"
                         : clean.format == ImageFormat::jpeg ? "jpeg"
                                                             : "webp";
    oiio::Input input(name, format, clean.bytes);
    const OIIO::ImageSpec& spec = input.spec();
    if (unsigned(spec.width) != clean.width || unsigned(spec.height) != clean.height || spec.nchannels > 4)
        throw Error(Exit::scene, "Image " + name + " cannot be read: its headers disagree about its size.");

    Image image{name, clean.width, clean.height, spec.format == OIIO::TypeDesc::UINT16 ? 16u : 8u, {}};
    const std::size_t row = std::size_t(image.width) * 4 * image.bits / 8;
    const OIIO::TypeDesc type = image.bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    image.texels.reserve(row * image.height);
    input.read_bands(type, [&](unsigned first, unsigned rows, const std::uint8_t* values) {
        image.texels.resize(row * (first + rows));
        std::uint8_t* to = image.texels.data() + row * first;
        const std::size_t pixels = std::size_t(rows) * image.width;
        if (image.bits == 16) {
            expand(reinterpret_cast<const std::uint16_t*>(values), unsigned(spec.nchannels), pixels,
                   reinterpret_cast<std::uint16_t*>(to));
        } else {
            expand(values, unsigned(spec.nchannels), pixels, to);
        }
    });
    return image;
}

}  // namespace triad
