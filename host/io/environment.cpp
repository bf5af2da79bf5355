/// Lat-long environment maps from Radiance .hdr and OpenEXR.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/memory_limit.h"
#include "io/exr_header.h"
#include "io/image_container.h"
#include "io/image_formats.h"
#include "io/io.h"

namespace triad {
namespace {

/// Where R, G and B lie among a file's channels; a single Y is grey.
std::array<std::size_t, 3> colour_channels(const std::string& name,
                                           const std::vector<std::string>& channels) {
    const auto find = [&](const char* channel) {
        return std::size_t(std::find(channels.begin(), channels.end(), channel) - channels.begin());
    };
    const std::size_t n = channels.size(), y = find("Y");
    const std::array<std::size_t, 3> rgb{find("R"), find("G"), find("B")};
    if (rgb[0] < n && rgb[1] < n && rgb[2] < n) return rgb;
    if (y < n) return {y, y, y};
    std::string list;
    for (const auto& channel : channels) list += (list.empty() ? "" : ", ") + channel;
    throw Error(Exit::scene,
                "Environment " + name + " has neither channels R, G, B nor Y; it has " + list + ".");
}

}  // namespace

EnvironmentMap load_environment(const std::filesystem::path& path, bool strict) {
    const std::string name = path.string();
    std::vector<std::uint8_t> bytes = read_file(path);
    const ImageFormat format = sniff(bytes);
    if (format == ImageFormat::exr) {
        bytes = clean_exr(name, bytes).bytes;
    } else if (format == ImageFormat::hdr) {
        bytes = clean_hdr(name, bytes).bytes;
    } else {
        throw Error(Exit::scene, "Environment " + name + " is neither Radiance .hdr nor OpenEXR.");
    }
    const auto reader =
        image_formats::loaded().read(name, format == ImageFormat::exr ? "openexr" : "hdr", bytes);
    const image_formats::Layout& layout = reader->layout();
    const std::size_t channels = layout.channels.size();
    const auto rgb = colour_channels(name, layout.channels);
    EnvironmentMap map{layout.width, layout.height, {}};
    require_memory(std::uint64_t(map.width) * map.height * 3 * sizeof(float), "Environment " + name);
    map.rgb.reserve(std::size_t(map.width) * map.height * 3);
    std::size_t repaired = 0;
    const auto take = [&](unsigned, unsigned rows, const std::uint8_t* values) {
        for (std::size_t i = 0; i < std::size_t(rows) * map.width; ++i) {
            bool bad = false;
            for (const std::size_t c : rgb) {
                float v;
                std::memcpy(&v, values + (i * channels + c) * sizeof v, sizeof v);
                const bool good = v >= 0.0f && std::isfinite(v);
                bad = bad || !good;
                map.rgb.push_back(good ? v : 0.0f);
            }
            repaired += bad;
        }
    };
    reader->read_bands(image_formats::Sample::f32, take);
    const std::string fault = "environment " + name + ": " + std::to_string(repaired) +
                              " texels are negative or not finite; those values are taken as 0";
    if (repaired > 0 && strict) throw Error(Exit::scene, fault + " without --strict.");
    if (repaired > 0) warn(fault);
    return map;
}

}  // namespace triad
