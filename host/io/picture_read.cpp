/// Pictures of any format as float channels.
#include <cstring>

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "io/image_formats.h"
#include "io/io.h"
#include "io/linear_decode.h"

namespace triad {
namespace {

/// What `decode` hands on of these channels, as a picture.
Picture picture_of(unsigned width, unsigned height, const std::vector<std::string>& names,
                   const auto& decode) {
    Picture picture;
    picture.width = width, picture.height = height;
    for (const std::string& name : names) picture.channels.push_back({name, {}});
    decode([&](unsigned rows, const float* values) {
        for (Channel& channel : picture.channels) {
            const float* v = values++;
            for (std::size_t p = 0; p < std::size_t(rows) * width; ++p, v += names.size())
                channel.values.push_back(*v);
        }
    });
    return picture;
}

/// PNG and JPEG. Values come scaled to [0, 1]: that is what OpenImageIO does on the way to float.
Picture read_encoded(const std::string& name, const char* format, std::span<const std::uint8_t> bytes) {
    const auto reader = image_formats::loaded().read(name, format, bytes);
    const image_formats::Layout& layout = reader->layout();
    Picture picture = picture_of(layout.width, layout.height, layout.channels, [&](const TakeRows& take) {
        std::vector<float> values;
        reader->read_bands(image_formats::Sample::f32,
                           [&](unsigned, unsigned rows, const std::uint8_t* bytes_of_rows) {
                               values.resize(std::size_t(rows) * layout.width * layout.channels.size());
                               std::memcpy(values.data(), bytes_of_rows, values.size() * sizeof(float));
                               take(rows, values.data());
                           });
    });
    if (const std::string damage = reader->complaint(); !damage.empty())
        warn("Image " + name + " is damaged (" + damage + "); what could be decoded of it is used.");
    return picture;
}

Picture read_exr(const std::string& name, std::span<const std::uint8_t> bytes) {
    const CleanExr clean = clean_exr(name, bytes);
    Picture picture = picture_of(clean.width, clean.height, clean.channels,
                                 [&](const TakeRows& take) { decode_exr(name, clean, take); });
    if (clean.x < 0 || clean.y < 0)
        throw Error(Exit::scene,
                    "Image " + name + " cannot be used: its data window begins outside its display window.");
    picture.x = unsigned(clean.x), picture.y = unsigned(clean.y);
    picture.full_width = clean.display_width, picture.full_height = clean.display_height;
    picture.metadata = clean.metadata;
    return picture;
}

Picture read_hdr(const std::string& name, std::span<const std::uint8_t> bytes) {
    const CleanImage clean = clean_hdr(name, bytes);
    return picture_of(clean.width, clean.height, {"R", "G", "B"},
                      [&](const TakeRows& take) { decode_hdr(name, clean, take); });
}

}  // namespace

Picture read_picture(const std::filesystem::path& path) {
    const std::string name = path.string();
    const std::vector<std::uint8_t> bytes = read_file(path);
    const ImageFormat format = sniff(bytes);
    if (format == ImageFormat::exr) return read_exr(name, bytes);
    if (format == ImageFormat::hdr) return read_hdr(name, bytes);
    if (format != ImageFormat::png && format != ImageFormat::jpeg)
        throw Error(Exit::scene, "Image " + name + " is no EXR, PNG, JPEG or Radiance .hdr.");
    const CleanImage clean = clean_image(name, bytes);
    Picture picture = read_encoded(name, format == ImageFormat::png ? "png" : "jpeg", clean.bytes);
    picture.metadata = clean.notes;
    picture.encoded = true;
    if (picture.channels.size() <= 2) {  // grey, with or without alpha
        const Channel grey = picture.channels[0];
        picture.channels.insert(picture.channels.begin(), 2, grey);
    }
    constexpr const char* names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < picture.channels.size(); ++c) picture.channels[c].name = names[c];
    return picture;
}

}  // namespace triad
