/// Pictures of any format as float channels.
#include <cstring>

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "io/exr_header.h"
#include "io/image_container.h"
#include "io/image_formats.h"
#include "io/io.h"

namespace triad {
namespace {

Picture read_channels(const std::string& name, const char* format, std::span<const std::uint8_t> bytes) {
    const auto reader = image_formats::loaded().read(name, format, bytes);
    const image_formats::Layout& layout = reader->layout();
    Picture picture;
    picture.width = layout.width, picture.height = layout.height;
    const std::size_t n = layout.channels.size();
    for (const std::string& channel : layout.channels) picture.channels.push_back({channel, {}});
    // Integer formats come scaled to [0, 1]: that is what OpenImageIO does on the way to float.
    const auto take = [&](unsigned, unsigned rows, const std::uint8_t* values) {
        for (std::size_t c = 0; c < n; ++c)
            for (std::size_t p = 0; p < std::size_t(rows) * picture.width; ++p) {
                float v;
                std::memcpy(&v, values + (p * n + c) * sizeof v, sizeof v);
                picture.channels[c].values.push_back(v);
            }
    };
    reader->read_bands(image_formats::Sample::f32, take);
    if (const std::string damage = reader->complaint(); !damage.empty())
        warn("Image " + name + " is damaged (" + damage + "); what could be decoded of it is used.");
    return picture;
}

Picture read_exr(const std::string& name, std::span<const std::uint8_t> bytes) {
    const CleanExr clean = clean_exr(name, bytes);
    Picture picture = read_channels(name, "openexr", clean.bytes);
    if (clean.x < 0 || clean.y < 0)
        throw Error(Exit::scene,
                    "Image " + name + " cannot be used: its data window begins outside its display window.");
    picture.x = unsigned(clean.x), picture.y = unsigned(clean.y);
    picture.full_width = clean.display_width, picture.full_height = clean.display_height;
    picture.metadata = clean.metadata;
    return picture;
}

}  // namespace

Picture read_picture(const std::filesystem::path& path) {
    const std::string name = path.string();
    const std::vector<std::uint8_t> bytes = read_file(path);
    const ImageFormat format = sniff(bytes);
    if (format == ImageFormat::exr) return read_exr(name, bytes);
    if (format == ImageFormat::hdr) return read_channels(name, "hdr", clean_hdr(name, bytes).bytes);
    if (format != ImageFormat::png && format != ImageFormat::jpeg)
        throw Error(Exit::scene, "Image " + name + " is no EXR, PNG, JPEG or Radiance .hdr.");
    const CleanImage clean = clean_image(name, bytes);
    Picture picture = read_channels(name, format == ImageFormat::png ? "png" : "jpeg", clean.bytes);
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
