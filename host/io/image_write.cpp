/// Pictures to EXR, PNG, JPEG and HDR. Everything is encoded in memory and then written aside, so that a full
/// disk is noticed before an older file is replaced.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <set>
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
using image_formats::Value;

void save(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
    write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Depths, positions, counts and weights lose their meaning in half precision.
bool must_be_float(const std::string& channel) {
    for (const char* layer : {"depth.", "position.", "samplecount.", "error.", "triad_weight"})
        if (channel.starts_with(layer)) return true;
    return channel == "Z";
}

/// Of Triad's names those whose values are numbers. All are double, which holds every count that there is.
const std::set<std::string> numbers{
    "triad:spp",         "triad:spp_min",   "triad:spp_max",   "triad:samples",        "triad:rays",
    "triad:not_finite",  "triad:saturated", "triad:truncated", "triad:cut_energy",     "triad:relmse",
    "triad:trend",       "triad:seed",      "triad:seconds",   "triad:compute_units",  "triad:ppd",
    "triad:max_texture", "triad:exposure",  "triad:pose_time", "triad:perceived_noise"};

/// pbrt-v4's names keep pbrt-v4's types (util/image.cpp), OpenEXR's have its own; other texts are strings.
Value typed(const std::string& name, const std::string& value) {
    const char* text = value.c_str();
    if (numbers.contains(name)) return std::strtod(text, nullptr);
    if (name == "renderTimeSeconds" || name == "MSE") return std::strtof(text, nullptr);
    if (name == "samplesPerPixel") return int(std::strtol(text, nullptr, 10));
    if (name != "worldToCamera" && name != "worldToNDC") return value;
    std::array<float, 16> matrix;
    for (float& v : matrix) {
        char* end;
        v = std::strtof(text, &end);
        text = end;
    }
    return matrix;
}

/// What R, G and B are: the primaries of Rec. 709 and sRGB with their white, D65. Drives of a panel are
/// colours of its own emitters.
constexpr std::array<float, 8> rec709{.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f};

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

std::vector<std::uint8_t> encode_exr(const Picture& picture, bool half, std::size_t* saturated) {
    std::vector<const Channel*> channels;
    for (const Channel& channel : picture.channels) channels.push_back(&channel);
    std::vector<float> values = interleave(picture, channels);

    Outline outline{picture.width, picture.height,     unsigned(channels.size()), picture.x,
                    picture.y,     picture.full_width, picture.full_height};
    std::size_t count = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const bool narrow = half && !must_be_float(channels[c]->name);
        outline.names.emplace_back(channels[c]->name, narrow ? Sample::f16 : Sample::f32);
        if (channels[c]->name == "A") outline.alpha = int(c);
        constexpr float half_max = 65504.0f;
        for (std::size_t i = c; narrow && i < values.size(); i += channels.size())
            if (std::abs(values[i]) > half_max) values[i] = std::copysign(half_max, values[i]), ++count;
    }
    auto& attributes = outline.attributes;
    attributes = {{"compression", "zip"}, {"oiio:ColorSpace", "Linear"}};
    // Else the writer adds the time: equal pictures have equal bytes.
    attributes.emplace_back("DateTime", "");
    for (const auto& [name, value] : picture.metadata) {
        if (name != "capDate") {
            attributes.emplace_back(name, typed(name, value));
            continue;
        }
        attributes.emplace_back("DateTime", value);  // universal time
        attributes.emplace_back("utcOffset", 0.0f);
    }
    if (picture.find("R") && !picture.metadata.contains("triad:panel"))
        attributes.emplace_back("chromaticities", rec709);
    if (saturated) *saturated = count;
    return image_formats::loaded().encode("openexr", outline, Sample::f32, values.data());
}

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
