#pragma once
/// Image files as untrusted bytes: recognised by their magic, measured from their headers, and rid of
/// everything but the pixels before a decoder sees them. Colour profiles, EXIF and XMP have crashed decoders;
/// Triad uses none of them.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace triad {

enum class ImageFormat { unknown, png, jpeg, webp, hdr, exr };

/// By the first bytes, never by the name.
ImageFormat sniff(std::span<const std::uint8_t> bytes);

/// The largest picture that is decoded, in pixels: 16384 x 8192.
inline constexpr std::uint64_t max_image_pixels = std::uint64_t(1) << 27;

/// The same picture with nothing but what its pixels need.
struct CleanImage {
    ImageFormat format = ImageFormat::unknown;
    unsigned width = 0, height = 0;
    std::vector<std::uint8_t> bytes;
    bool ends_early = false;                   ///< a JPEG without its end marker
    std::map<std::string, std::string> notes;  ///< Triad's own text ("triad:...") of PNG and JPEG, short ones
};

/// Strips PNG, JPEG or WebP bytes. Throws Error(scene) with `name` when the container is damaged, is none of
/// the three, or announces more than max_image_pixels or more pixels than its bytes can hold.
CleanImage clean_image(const std::string& name, std::span<const std::uint8_t> bytes);

/// WebP bytes without their alpha: OpenImageIO multiplies WebP colours by alpha whatever it is told, so that
/// colours are decoded apart.
CleanImage clean_webp_colour(const std::string& name, std::span<const std::uint8_t> bytes);

/// The pixels of a Radiance .hdr, without its header. Throws Error(scene).
CleanImage clean_hdr(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace triad
