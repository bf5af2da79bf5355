/// The images of a scene, decoded when all are known: how large they may be is decided by their headers.
#include <algorithm>
#include <mutex>

#include "base/error.h"
#include "base/files.h"
#include "base/memory_limit.h"
#include "base/parallel_for.h"
#include "base/text.h"
#include "io/gltf_images.h"
#include "io/gltf_material.h"
#include "io/gltf_specular_glossiness.h"
#include "io/image_container.h"
#include "scene/image_reduce.h"

namespace triad::gltf {
namespace {

constexpr std::uint64_t image_cap = std::uint64_t(1) << 30;  // bytes of an encoded image
/// Of the memory that is left, images may take one of so many parts: the scene holds them, its packing does,
/// and so does a device that is not in the host's memory; trees and film come beside.
constexpr std::uint64_t parts_for_images = 3;

/// Of an image that is not decoded yet.
struct Header {
    unsigned width = 0, height = 0, bits = 8;
    bool is_colour = false;

    std::uint64_t bytes(unsigned longer) const {
        const uvec2 size = longer ? reduced_size(width, height, longer) : uvec2(width, height);
        return std::uint64_t(size.x) * size.y * 4 * (bits / 8);
    }
};

Header header_of(const std::string& name, const std::vector<std::uint8_t>& bytes) {
    const CleanImage clean = clean_image(name, bytes);
    const bool deep = clean.format == ImageFormat::png && clean.bytes[24] == 16;  // bit depth in IHDR
    return {clean.width, clean.height, deep ? 16u : 8u, false};
}

std::uint64_t bytes_of(const std::vector<Header>& headers, unsigned longer) {
    std::uint64_t sum = 0;
    for (const Header& header : headers) sum += header.bytes(longer);
    return sum;
}

/// The same as packed: with levels, which take a third of what they are of.
std::uint64_t packed_bytes_of(const std::vector<Header>& headers, unsigned longer) {
    std::uint64_t sum = bytes_of(headers, longer);
    for (const Header& header : headers)
        if (header.is_colour) sum += header.bytes(longer) / 3;
    return sum;
}

/// The largest power of two to which images must be reduced for the memory limit; 0: they fit as they are.
unsigned fitting_size(const std::vector<Header>& headers) {
    const std::uint64_t limit = memory_limit(), used = memory_in_use();
    const std::uint64_t room = limit == 0 ? UINT64_MAX : (limit - std::min(used, limit)) / parts_for_images;
    if (packed_bytes_of(headers, 0) <= room) return 0;
    unsigned longer = 1 << 16;
    while (longer > 1 && packed_bytes_of(headers, longer) > room) longer /= 2;
    return longer;
}

}  // namespace

std::vector<std::uint8_t> bytes_of(const ImageSource& source) {
    std::vector<std::uint8_t> bytes;
    if (source.path.empty())
        bytes.assign(source.bytes.begin(), source.bytes.end());
    else
        bytes = triad::read_file(source.path, image_cap);
    return bytes;
}

void Materials::decode_images(std::optional<unsigned> wanted) {
    std::vector<Image>& images = scene_.images;
    const auto source_of = [&](std::size_t i) -> const ImageSource& {
        return file_.images[std::size_t(image_sources_[i].first)];
    };
    const auto decoded = [&](std::size_t i, std::string* damage) {
        Image image = decode_image(source_of(i).name, bytes_of(source_of(i)), damage);
        if (const auto& glossiness = image_sources_[i].second) make_roughness(image, *glossiness);
        return image;
    };
    std::vector<Header> headers(images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        headers[i] = header_of(source_of(i).name, bytes_of(source_of(i)));
        headers[i].is_colour = colours_.contains(i);
    }
    const unsigned longer = wanted ? *wanted : fitting_size(headers);
    const auto is_reduced = [&](const Header& h) {
        return longer > 0 && std::max(h.width, h.height) > longer;
    };
    const std::string all = "Decoding the " +
                            (images.size() == 1 ? "image" : std::to_string(images.size()) + " images") +
                            " of the scene";
    if (!images.empty()) require_memory(bytes_of(headers, longer), all);
    if (std::any_of(headers.begin(), headers.end(), is_reduced)) {
        file_.report.max_texture = longer;
        if (!wanted)
            file_.warn(all + " would take " + bytes_text(bytes_of(headers, 0)) +
                       ", too much of the memory that is allowed: those with more than " +
                       std::to_string(longer) +
                       " texels on their longer side are reduced to that (--max-texture N chooses, a larger "
                       "--max-memory allows more).");
    }

    std::vector<std::string> damage(images.size());
    std::mutex one_large;  // of those that are reduced one is in memory as a whole
    parallel_for(images.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!is_reduced(headers[i])) {
                images[i] = decoded(i, &damage[i]);
                continue;
            }
            const std::lock_guard lock(one_large);
            images[i] = reduced(decoded(i, &damage[i]), longer, headers[i].is_colour);
        }
    });
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!damage[i].empty())
            file_.fault(images[i].name + " is damaged (" + damage[i] +
                        "); what could be decoded of it is used.");
}

}  // namespace triad::gltf
