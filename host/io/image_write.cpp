/// Pictures to JPEG and HDR, and files of pictures. Everything is encoded in memory and then written aside,
/// so that a full disk is noticed before an older file is replaced.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "base/colour.h"
#include "base/error.h"
#include "base/files.h"
#include "io/image_formats.h"
#include "io/io.h"
#include "io/png_write.h"

namespace triad {
namespace {

using image_formats::Outline;
using image_formats::Sample;

void save(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
    write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// The channels side by side, interleaved. Throws std::logic_error when a channel has not one value per
/// pixel.
std::vector<float> interleave(const Picture& picture, const std::vector<const Channel*>& channels) {
    const std::size_t pixels = std::size_t(picture.width) * picture.height, n = channels.size();
    if (pixels == 0 || n == 0)
        throw Error(Exit::scene, "There is no picture to write: it has no pixels or no channels.");
    std::vector<float> values(pixels * n);
    for (std::size_t c = 0; c < n; ++c) {
        if (channels[c]->values.size() != pixels)
            throw std::logic_error("channel " + channels[c]->name + " does not have one value per pixel");
        for (std::size_t p = 0; p < pixels; ++p) values[p * n + c] = channels[c]->values[p];
    }
    return values;
}

/// JPEG has 8 bits and no alpha: the picture is put on black, in linear light.
EncodedPicture for_jpeg(const EncodedPicture& picture) {
    EncodedPicture out{picture.width,   picture.height, std::min(picture.channels, 3u), 8, {},
                       picture.metadata};
    const auto sample = [&](std::size_t i) -> double {
        if (picture.bits == 8) return picture.bytes[i] / 255.0;
        std::uint16_t v;
        std::memcpy(&v, picture.bytes.data() + 2 * i, sizeof v);
        return v / 65535.0;
    };
    out.bytes.reserve(std::size_t(out.width) * out.height * out.channels);
    for (std::size_t p = 0; p < std::size_t(out.width) * out.height; ++p) {
        const double alpha = picture.channels == 4 ? sample(p * 4 + 3) : 1.0;
        for (unsigned c = 0; c < out.channels; ++c) {
            const double v = sample(p * picture.channels + c);
            out.bytes.push_back(
                std::uint8_t(std::lround(255.0 * (alpha == 1.0 ? v : srgb_encode(srgb_decode(v) * alpha)))));
        }
    }
    return out;
}

}  // namespace

const Channel* Picture::find(const std::string& name) const {
    const auto at =
        std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
    return at == channels.end() ? nullptr : &*at;
}

void load_picture_formats() { image_formats::loaded(); }

std::vector<std::uint8_t> encode_hdr(const Picture& picture) {
    std::vector<const Channel*> channels;
    for (const char* name : {"R", "G", "B"}) {
        channels.push_back(picture.find(name));
        if (!channels.back())
            throw Error(Exit::usage, "A Radiance .hdr holds R, G and B, and this picture has no " +
                                         std::string(name) + ".");
    }
    std::vector<float> values = interleave(picture, channels);
    constexpr float rgbe_max = 1.6e38f;  // below 2^127: the exponent byte of RGBE ends there
    for (float& v : values)
        v = v > 0.0f ? std::min(v, rgbe_max) : 0.0f;  // NaN and negatives: RGBE has neither
    return image_formats::loaded().encode("hdr", {picture.width, picture.height, 3}, Sample::f32,
                                          values.data());
}

std::vector<std::uint8_t> encode_picture(const std::string& extension, const EncodedPicture& given) {
    std::string lower = extension;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    const bool jpeg = lower == ".jpg" || lower == ".jpeg";
    if (!jpeg && lower != ".png")
        throw Error(Exit::usage, "Cannot write a picture as \"" + extension +
                                     "\": .exr, .png, .jpg and .hdr are possible.");
    const bool channels_right = given.channels == 1 || given.channels == 3 || given.channels == 4;
    if (!channels_right || (given.bits != 8 && given.bits != 16) ||
        given.bytes.size() != std::size_t(given.width) * given.height * given.channels * given.bits / 8)
        throw std::logic_error("the encoded picture does not have the bytes that its size says");
    if (given.bytes.empty()) throw Error(Exit::scene, "There is no picture to write: it has no pixels.");
    if (jpeg && std::max(given.width, given.height) > 65500)
        throw Error(Exit::usage, "A JPEG has at most 65500 pixels in a row or column; write .png or .exr.");

    if (!jpeg) return encode_png(given);

    const EncodedPicture picture = for_jpeg(given);
    Outline outline{picture.width, picture.height, picture.channels};
    auto& attributes = outline.attributes;
    attributes = {{"oiio:UnassociatedAlpha", 1},
                  {"oiio:ColorSpace", "sRGB"},
                  {"Compression", "jpeg:95"},
                  {"jpeg:subsampling", "4:4:4"}};
    std::string text;
    for (const auto& [name, value] : picture.metadata) text += name + "=" + value + "\n";
    if (!text.empty()) attributes.emplace_back("ImageDescription", text);
    return image_formats::loaded().encode("jpeg", outline, Sample::u8, picture.bytes.data());
}

std::size_t write_exr(const std::filesystem::path& path, const Picture& picture, bool half) {
    std::size_t saturated = 0;
    save(path, encode_exr(picture, half, &saturated));
    return saturated;
}

void write_hdr(const std::filesystem::path& path, const Picture& picture) { save(path, encode_hdr(picture)); }

void write_encoded(const std::filesystem::path& path, const EncodedPicture& picture) {
    save(path, encode_picture(path.extension().string(), picture));
}

}  // namespace triad
