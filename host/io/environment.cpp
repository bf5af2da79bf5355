/// Lat-long environment maps from Radiance .hdr and OpenEXR.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/memory_limit.h"
#include "io/io.h"
#include "io/linear_decode.h"

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

/// What `decode` hands on of these channels, as a map.
EnvironmentMap environment_of(const std::string& name, unsigned width, unsigned height,
                              const std::vector<std::string>& channels, bool strict, const auto& decode) {
    const auto rgb = colour_channels(name, channels);
    EnvironmentMap map{width, height, {}};
    require_memory(std::uint64_t(width) * height * 3 * sizeof(float), "Environment " + name);
    map.rgb.reserve(std::size_t(width) * height * 3);
    std::size_t repaired = 0;
    decode([&](unsigned rows, const float* values) {
        for (std::size_t i = 0; i < std::size_t(rows) * width; ++i) {
            bool bad = false;
            for (const std::size_t c : rgb) {
                const float v = values[i * channels.size() + c];
                const bool good = v >= 0.0f && std::isfinite(v);
                bad = bad || !good;
                map.rgb.push_back(good ? v : 0.0f);
            }
            repaired += bad;
        }
    });
    const std::string fault = "environment " + name + ": " + std::to_string(repaired) +
                              " texels are negative or not finite; those values are taken as 0";
    if (repaired > 0 && strict) throw Error(Exit::scene, fault + " without --strict.");
    if (repaired > 0) warn(fault);
    return map;
}

}  // namespace

EnvironmentMap load_environment(const std::filesystem::path& path, bool strict) {
    const std::string name = path.string();
    const std::vector<std::uint8_t> bytes = read_file(path);
    switch (sniff(bytes)) {
        case ImageFormat::exr: {
            const CleanExr exr = clean_exr(name, bytes);
            return environment_of(name, exr.width, exr.height, exr.channels, strict,
                                  [&](const TakeRows& take) { decode_exr(name, exr, take); });
        }
        case ImageFormat::hdr: {
            const CleanImage hdr = clean_hdr(name, bytes);
            return environment_of(name, hdr.width, hdr.height, {"R", "G", "B"}, strict,
                                  [&](const TakeRows& take) { decode_hdr(name, hdr, take); });
        }
        default:
            throw Error(Exit::scene, "Environment " + name + " is neither Radiance .hdr nor OpenEXR.");
    }
}

}  // namespace triad
