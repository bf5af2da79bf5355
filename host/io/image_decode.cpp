/// PNG, JPEG and WebP bytes to RGBA texels.
#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "base/memory_limit.h"
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

/// Replaces the colours of a WebP image with alpha, which come multiplied by it, by the stored ones.
void restore_webp_colours(Image& image, const std::vector<std::uint8_t>& bytes) {
    const CleanImage colour = clean_webp_colour(image.name, bytes);
    oiio::Input input(image.name, "webp", colour.bytes);
    const unsigned n = unsigned(input.spec().nchannels);
    if (n < 3 || unsigned(input.spec().width) != image.width || unsigned(input.spec().height) != image.height)
        throw Error(Exit::scene,
                    "Image " + image.name + " cannot be read: its colours and its alpha differ in size.");
    input.read_bands(OIIO::TypeDesc::UINT8, [&](unsigned first, unsigned rows, const std::uint8_t* values) {
        std::uint8_t* to = image.texels.data() + std::size_t(first) * image.width * 4;
        for (std::size_t i = 0; i < std::size_t(rows) * image.width; ++i, values += n, to += 4)
            std::copy_n(values, 3, to);
    });
}

}  // namespace

Image decode_image(const std::string& name, const std::vector<std::uint8_t>& bytes, std::string* damage) {
    const CleanImage clean = clean_image(name, bytes);
    const char* format = clean.format == ImageFormat::png    ? "png"
                         : clean.format == ImageFormat::jpeg ? "jpeg"
                                                             : "webp";
    require_memory(std::uint64_t(clean.width) * clean.height * 4, "Image " + name);
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
    if (damage) {
        *damage = input.complaint();
        if (damage->empty() && clean.ends_early) *damage = "it ends before its end marker";
    }
    if (clean.format == ImageFormat::webp && spec.nchannels == 4) restore_webp_colours(image, bytes);
    return image;
}

}  // namespace triad
