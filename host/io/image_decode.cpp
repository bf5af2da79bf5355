/// PNG, JPEG and WebP bytes to RGBA texels.
#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "base/memory_limit.h"
#include "io/image_container.h"
#include "io/image_formats.h"
#include "io/io.h"

namespace triad {
namespace {

using image_formats::Sample;

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
    const auto reader = image_formats::loaded().read(image.name, "webp", colour.bytes);
    const image_formats::Layout& layout = reader->layout();
    const std::size_t n = layout.channels.size();
    if (n < 3 || layout.width != image.width || layout.height != image.height)
        throw Error(Exit::scene,
                    "Image " + image.name + " cannot be read: its colours and its alpha differ in size.");
    reader->read_bands(Sample::u8, [&](unsigned first, unsigned rows, const std::uint8_t* values) {
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
    const auto reader = image_formats::loaded().read(name, format, clean.bytes);
    const image_formats::Layout& layout = reader->layout();
    const unsigned channels = unsigned(layout.channels.size());
    if (layout.width != clean.width || layout.height != clean.height || channels > 4)
        throw Error(Exit::scene, "Image " + name + " cannot be read: its headers disagree about its size.");

    Image image{name, clean.width, clean.height, layout.wide ? 16u : 8u, {}};
    const std::size_t row = std::size_t(image.width) * 4 * image.bits / 8;
    image.texels.reserve(row * image.height);
    reader->read_bands(layout.wide ? Sample::u16 : Sample::u8,
                       [&](unsigned first, unsigned rows, const std::uint8_t* values) {
                           image.texels.resize(row * (first + rows));
                           std::uint8_t* to = image.texels.data() + row * first;
                           const std::size_t pixels = std::size_t(rows) * image.width;
                           if (image.bits == 16) {
                               expand(reinterpret_cast<const std::uint16_t*>(values), channels, pixels,
                                      reinterpret_cast<std::uint16_t*>(to));
                           } else {
                               expand(values, channels, pixels, to);
                           }
                       });
    if (damage) {
        *damage = reader->complaint();
        if (damage->empty() && clean.ends_early) *damage = "it ends before its end marker";
    }
    if (clean.format == ImageFormat::webp && channels == 4) restore_webp_colours(image, bytes);
    return image;
}

}  // namespace triad
