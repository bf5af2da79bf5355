#include "io/image_container.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "base/error.h"

namespace triad {
namespace {

using Span = std::span<const std::uint8_t>;

std::uint32_t big16(Span b, std::size_t at) { return std::uint32_t(b[at]) << 8 | b[at + 1]; }
std::uint32_t big32(Span b, std::size_t at) { return big16(b, at) << 16 | big16(b, at + 2); }
std::uint32_t little16(Span b, std::size_t at) { return std::uint32_t(b[at + 1]) << 8 | b[at]; }
std::uint32_t little24(Span b, std::size_t at) { return std::uint32_t(b[at + 2]) << 16 | little16(b, at); }
std::uint32_t little32(Span b, std::size_t at) { return little16(b, at + 2) << 16 | little16(b, at); }

bool has(Span b, std::size_t at, std::string_view text) {
    return at <= b.size() && text.size() <= b.size() - at &&
           std::memcmp(b.data() + at, text.data(), text.size()) == 0;
}

void append(std::vector<std::uint8_t>& to, Span part) {
    const std::size_t at = to.size();
    to.resize(at + part.size());
    std::copy(part.begin(), part.end(), to.begin() + std::ptrdiff_t(at));
}

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw Error(Exit::scene, "Image " + name + " cannot be used: " + why + ".");
}

void check_size(const std::string& name, std::uint64_t width, std::uint64_t height) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width == 0 || height == 0) refuse(name, "its header says " + size + " pixels");
    if (width * height > max_image_pixels)
        refuse(name, "its header says " + size + " pixels, and the limit is " +
                         std::to_string(max_image_pixels) + " in all");
}

/// Keeps a text that Triad wrote; others', and long ones, are of no use.
void keep_note(CleanImage& clean, std::string_view key, std::string_view value) {
    if (key.starts_with("triad:") && key.size() <= 64 && value.size() <= 256)
        clean.notes.emplace(std::string(key), std::string(value));
}

constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

/// PNG (ISO/IEC 15948) 5.3: length, type, data, CRC. Kept are the critical chunks and tRNS.
CleanImage clean_png(const std::string& name, Span b) {
    CleanImage clean{ImageFormat::png, 0, 0, {}};
    append(clean.bytes, b.first(png_magic.size()));
    std::uint64_t raw = 0, packed = 0;  // bytes of the unpacked scanlines, and of the IDAT chunks
    for (std::size_t at = png_magic.size();;) {
        if (b.size() - at < 12) refuse(name, "the PNG ends before its IEND chunk");
        const std::size_t length = big32(b, at);
        if (length > b.size() - at - 12) refuse(name, "a PNG chunk is longer than the file");
        const std::string_view type(reinterpret_cast<const char*>(b.data()) + at + 4, 4);
        const bool first = at == png_magic.size();
        if (first != (type == "IHDR")) refuse(name, "the PNG has no IHDR chunk at its start, or two of them");
        if (first) {
            if (length != 13) refuse(name, "its IHDR chunk is damaged");
            clean.width = big32(b, at + 8), clean.height = big32(b, at + 12);
            check_size(name, clean.width, clean.height);
            constexpr std::array<unsigned, 7> channels{1, 0, 3, 1, 2, 0, 4};  // by colour type
            const unsigned bits = b[at + 16], colour = b[at + 17];
            if (colour > 6 || channels[colour] == 0 || bits == 0 || bits > 16)
                refuse(name, "its IHDR chunk is damaged");
            raw = (std::uint64_t(clean.width) * channels[colour] * bits / 8 + 1) * clean.height;
        }
        if (type == "IDAT") packed += length;
        const bool critical = (type[0] & 0x20) == 0;
        const bool known = type == "IHDR" || type == "PLTE" || type == "IDAT" || type == "IEND";
        if (critical && !known)
            refuse(name, "it has a PNG chunk of unknown meaning that readers must understand");
        if (critical || type == "tRNS") append(clean.bytes, b.subspan(at, length + 12));
        if (type == "tEXt") {
            const std::string_view text(reinterpret_cast<const char*>(b.data()) + at + 8, length);
            if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
                keep_note(clean, text.substr(0, zero), text.substr(zero + 1));
        }
        at += length + 12;
        if (type == "IEND") break;
    }
    // Deflate packs at most 1032 to 1; interlacing adds less than this slack.
    if (raw / 1032 > packed + 1024) refuse(name, "its data are too short for the size in its header");
    return clean;
}

/// JPEG (ITU-T T.81 annex B): marker segments up to EOI. Dropped are comments and all APPn but Adobe's APP14,
/// which names the colour transform and is cut to its 12 fixed bytes.
CleanImage clean_jpeg(const std::string& name, Span b) {
    CleanImage clean{ImageFormat::jpeg, 0, 0, {0xff, 0xd8}};
    std::uint64_t scans = 0;
    for (std::size_t at = 2;;) {
        while (at + 1 < b.size() && b[at] == 0xff && b[at + 1] == 0xff) ++at;  // fill bytes
        if (b.size() - at < 2) {
            clean.ends_early = true;
            break;
        }
        if (b[at] != 0xff) refuse(name, "the JPEG has no marker where one is due");
        const unsigned marker = b[at + 1];
        if (marker == 0xd9) break;
        if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) {  // TEM, RSTn: no length, no meaning here
            at += 2;
            continue;
        }
        if (marker == 0xd8 || marker == 0x00) refuse(name, "the JPEG has a marker in the wrong place");
        const std::size_t left = b.size() - at - 2;
        const std::size_t length = left < 2 ? 0 : big16(b, at + 2);
        if (length < 2 || length > left) refuse(name, "a JPEG segment is longer than the file");
        const Span segment = b.subspan(at, length + 2);
        at += length + 2;
        const bool frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame) {
            if (clean.width != 0) refuse(name, "the JPEG has two frame headers");
            if (length < 8) refuse(name, "the JPEG frame header is damaged");
            clean.height = big16(segment, 5), clean.width = big16(segment, 7);
            check_size(name, clean.width, clean.height);
        }
        if (marker == 0xfe) {  // a comment: lines of key=value, as Triad writes them
            std::string_view text(reinterpret_cast<const char*>(segment.data()) + 4, segment.size() - 4);
            while (!text.empty()) {
                const std::string_view line = text.substr(0, text.find('\n'));
                if (const std::size_t equals = line.find('='); equals != std::string_view::npos)
                    keep_note(clean, line.substr(0, equals), line.substr(equals + 1));
                text.remove_prefix(std::min(text.size(), line.size() + 1));
            }
        }
        if (marker == 0xee && has(segment, 4, "Adobe") && length >= 14) {
            append(clean.bytes, std::array<std::uint8_t, 4>{0xff, 0xee, 0, 14});
            append(clean.bytes, segment.subspan(4, 12));
        } else if (marker < 0xe0 || (marker > 0xef && marker != 0xfe)) {
            append(clean.bytes, segment);
        }
        if (marker ==
            0xda) {  // entropy-coded data follow, up to a marker that is neither stuffing nor restart
            if (clean.width == 0) refuse(name, "the JPEG has data before its frame header");
            const std::size_t begin = at;
            while (at + 1 < b.size() && !(b[at] == 0xff && b[at + 1] != 0 &&
                                          (b[at + 1] < 0xd0 || b[at + 1] > 0xd7) && b[at + 1] != 0xff))
                ++at;
            if (at + 1 >= b.size()) at = b.size();
            append(clean.bytes, b.subspan(begin, at - begin));
            // Each scan of a progressive file costs a pass over the picture, however few bytes it has.
            if (++scans * clean.width * clean.height > max_image_pixels * 16 || scans > 200)
                refuse(name, "it has more JPEG scans than any picture needs");
        }
    }
    if (scans == 0) refuse(name, "the JPEG has no picture data");
    append(clean.bytes, std::array<std::uint8_t, 2>{0xff, 0xd9});
    return clean;
}

/// WebP (RFC 9649): RIFF chunks. Kept are VP8X, ALPH, VP8 and VP8L; without alpha only VP8, or VP8L with its
/// alpha hint off.
CleanImage clean_webp(const std::string& name, Span b, bool with_alpha) {
    CleanImage clean{ImageFormat::webp, 0, 0, {b.begin(), b.begin() + 12}};
    bool pixels = false;
    for (std::size_t at = 12; b.size() - at >= 8;) {
        const std::size_t length = little32(b, at + 4);
        if (length > b.size() - at - 8) refuse(name, "a WebP chunk is longer than the file");
        const Span data = b.subspan(at + 8, length);
        const bool extended = has(b, at, "VP8X"), lossy = has(b, at, "VP8 "), lossless = has(b, at, "VP8L");
        if (has(b, at, "ANIM") || has(b, at, "ANMF")) refuse(name, "it is an animation");
        if (length < (extended || lossy ? 10u : lossless ? 5u : 0u))
            refuse(name, "its WebP header is damaged");
        unsigned width = 0, height = 0;
        if (extended) width = little24(data, 4) + 1, height = little24(data, 7) + 1;
        if (lossy) width = little16(data, 6) & 0x3fff, height = little16(data, 8) & 0x3fff;
        if (lossless)
            width = (little32(data, 1) & 0x3fff) + 1, height = (little32(data, 1) >> 14 & 0x3fff) + 1;
        if (extended || lossy || lossless) {
            check_size(name, width, height);
            if (clean.width != 0 && (clean.width != width || clean.height != height))
                refuse(name, "its WebP headers disagree about its size");
            clean.width = width, clean.height = height;
        }
        if (lossy || lossless || (with_alpha && (extended || has(b, at, "ALPH")))) {
            const std::size_t start = clean.bytes.size();
            append(clean.bytes, b.subspan(at, 8));
            append(clean.bytes, data);
            if (length & 1) clean.bytes.push_back(0);
            if (lossless && !with_alpha) clean.bytes[start + 12] &= 0xef;
            if (extended)
                clean.bytes[start + 8] &= 0x10;  // of the flags only alpha: no ICC, EXIF, XMP, animation
        }
        pixels = pixels || lossy || lossless;
        at += std::min(8 + length + (length & 1), b.size() - at);
    }
    if (!pixels) refuse(name, "the WebP has no picture data");
    const std::uint32_t riff = std::uint32_t(clean.bytes.size() - 8);
    for (unsigned i = 0; i < 4; ++i) clean.bytes[4 + i] = std::uint8_t(riff >> (8 * i));
    return clean;
}

}  // namespace

ImageFormat sniff(Span b) {
    if (has(b, 0, png_magic)) return ImageFormat::png;
    if (has(b, 0, "\xff\xd8\xff")) return ImageFormat::jpeg;
    if (has(b, 0, "RIFF") && has(b, 8, "WEBP")) return ImageFormat::webp;
    if (has(b, 0, "#?RADIANCE") || has(b, 0, "#?RGBE")) return ImageFormat::hdr;
    if (has(b, 0, "\x76\x2f\x31\x01")) return ImageFormat::exr;
    return ImageFormat::unknown;
}

CleanImage clean_image(const std::string& name, Span b) {
    switch (sniff(b)) {
        case ImageFormat::png:
            return clean_png(name, b);
        case ImageFormat::jpeg:
            return clean_jpeg(name, b);
        case ImageFormat::webp:
            return clean_webp(name, b, true);
        default:
            refuse(name, "it is no PNG, JPEG or WebP");
    }
}

CleanImage clean_webp_colour(const std::string& name, Span b) { return clean_webp(name, b, false); }

/// Radiance picture format (Ward): text lines up to an empty one, then "-Y height +X width", then pixels.
CleanImage clean_hdr(const std::string& name, Span b) {
    const std::string_view text(reinterpret_cast<const char*>(b.data()),
                                std::min<std::size_t>(b.size(), 65536));
    const std::size_t blank = text.find("\n\n");
    const std::size_t end = blank == text.npos ? blank : text.find('\n', blank + 2);
    if (end == text.npos) refuse(name, "its Radiance header has no end");
    if (text.substr(0, blank + 1).find("\nFORMAT=32-bit_rle_xyze\n") != text.npos)
        refuse(name, "its colours are XYZ; save it as RGBE");
    unsigned width = 0, height = 0;
    int used = 0;
    const std::string line(text.substr(blank + 2, end - blank - 2));
    if (line.size() > 64 || std::sscanf(line.c_str(), "-Y %9u +X %9u%n", &height, &width, &used) != 2 ||
        std::size_t(used) != line.size())
        refuse(name,
               "it is not stored from the top left, row by row (its Radiance header must say -Y height +X "
               "width)");
    check_size(name, width, height);
    const Span pixels = b.subspan(end + 1);
    if (pixels.size() / 4 < height) refuse(name, "its data are too short for the size in its header");
    return {ImageFormat::hdr, width, height, {pixels.begin(), pixels.end()}};
}

}  // namespace triad
