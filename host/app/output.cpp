#include "app/output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "base/colour.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/parallel_for.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

std::string extension_of(const std::string& path) {
    if (path == "-") return ".png";
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

bool is_linear_format(const std::string& extension) { return extension == ".exr" || extension == ".hdr"; }

/// The channels a person sees. `alpha` is null when the picture is opaque.
struct Colours {
    const std::vector<float>*rgb[3], *alpha;

    explicit Colours(const Picture& picture) {
        const char* const names[] = {"R", "G", "B"};
        for (int c = 0; c < 3; ++c) {
            const Channel* channel = picture.find(names[c]);
            if (!channel)
                throw Error(Exit::scene, "The picture has no channel " + std::string(names[c]) + ".");
            rgb[c] = &channel->values;
        }
        const Channel* a = picture.find("A");
        alpha = a ? &a->values : nullptr;
    }
    vec3 colour(std::size_t i) const { return {(*rgb[0])[i], (*rgb[1])[i], (*rgb[2])[i]}; }
};

/// Exposure, tone map, background, sRGB curve, rounding.
EncodedPicture encoded(const Picture& linear, const OutputStyle& style) {
    const Colours in(linear);
    const ToneMap map = *tone_map_named(style.tone_map);
    const auto gain = static_cast<float>(std::exp2(style.exposure));
    const bool keep_alpha = in.alpha && !style.background;
    EncodedPicture out{linear.width, linear.height, keep_alpha ? 4u : 3u, style.bits, {}, linear.metadata};
    const std::size_t pixels = std::size_t(out.width) * out.height;
    out.bytes.resize(pixels * out.channels * out.bits / 8);
    auto put = [&](std::size_t i, double value) {
        if (out.bits == 8) {
            out.bytes[i] = static_cast<std::uint8_t>(std::lround(value * 255));
        } else {
            const auto v = static_cast<std::uint16_t>(std::lround(value * 65535));
            std::copy_n(reinterpret_cast<const std::uint8_t*>(&v), 2, &out.bytes[2 * i]);
        }
    };
    parallel_for(pixels, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float alpha = in.alpha ? std::clamp((*in.alpha)[i], 0.0f, 1.0f) : 1.0f;
            // The curve sees the colour as if it covered the pixel: edges keep the colour of their object.
            vec3 c = alpha > 0 ? tone_mapped(map, in.colour(i) * (gain / alpha)) : vec3(0.0f);
            if (style.background) c = glm::mix(*style.background, c, alpha);
            for (unsigned k = 0; k < 3; ++k) put(i * out.channels + k, srgb_encode(c[k]));
            if (keep_alpha) put(i * out.channels + 3, alpha);
        }
    });
    return out;
}

/// The picture over the background colour, without alpha; the same picture when there is nothing to do.
Picture composited(Picture linear, const OutputStyle& style) {
    if (!style.background || !linear.find("A")) return linear;
    const std::vector<float> alpha = linear.find("A")->values;
    std::erase_if(linear.channels, [](const Channel& channel) { return channel.name == "A"; });
    const char* const names[] = {"R", "G", "B"};
    for (Channel& channel : linear.channels)
        for (int c = 0; c < 3; ++c)
            if (channel.name == names[c])
                for (std::size_t i = 0; i < alpha.size(); ++i)
                    channel.values[i] += (1 - alpha[i]) * (*style.background)[c];
    return linear;
}

void write_standard_output(const std::vector<std::uint8_t>& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        throw Error(Exit::scene, "Cannot write the picture to standard output: it is closed or full.");
}

}  // namespace

void declare_style(CLI::App& command, OutputStyle& style) {
    const char* const group = "Output";
    command.add_option("--exposure", style.exposure, "In EV, for tone-mapped outputs (default 0)")
        ->check(CLI::Range(-64.0, 64.0))
        ->type_name("EV")
        ->group(group);
    command.add_option("--tonemap", style.tone_map, "none, aces, agx or khronos (the default: PBR Neutral)")
        ->check(CLI::IsMember({"none", "aces", "agx", "khronos"}))
        ->type_name("NAME")
        ->group(group);
    command.add_option("--bits", style.bits, "Of PNG outputs, 8 or 16 (default 8)")
        ->check(CLI::IsMember({8, 16}))
        ->type_name("N")
        ->group(group);
    command.add_flag("--half", style.half, "16-bit EXR instead of 32-bit")->group(group);
}

bool is_exr(const std::string& path) { return extension_of(path) == ".exr"; }

void check_format(const std::string& path) {
    const std::string extension = extension_of(path);
    for (const char* known : {".exr", ".hdr", ".png", ".jpg", ".jpeg"})
        if (extension == known) return;
    throw Error(
        Exit::usage,
        "-o " + path + ": the extension must be .exr, .hdr, .png or .jpg (or - for PNG on standard output).");
}

void check_writable(const std::string& path) {
    if (path == "-") return;
    if (fs::is_directory(path)) throw Error(Exit::scene, "Cannot write " + path + ": it is a folder.");
    // What writing will do: make a file beside it. Only the attempt tells; access rights are not the whole
    // story.
    const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
        throw Error(Exit::scene, "Cannot write " + path + ": there is no folder " + folder.string() + ".");
    if (fs::exists(path) && !fs::is_regular_file(path)) return;  // a device or pipe is written to directly
    const fs::path probe = folder / (".triad-probe" + fs::path(path).filename().string());
    write_file(probe, "");
    fs::remove(probe);
}

Picture linear_picture(const Film& film, bool alpha) {
    Picture picture{film.width, film.height, film.x, film.y, film.full_width, film.full_height, {}, {}};
    const char* const names[] = {"R", "G", "B", "A"};
    for (int c = 0; c < (alpha ? 4 : 3); ++c)
        picture.channels.push_back({names[c], std::vector<float>(film.pixels())});
    parallel_for(film.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::array<double, 4> mean = pixel_mean(film, i);
            for (std::size_t c = 0; c < picture.channels.size(); ++c)
                picture.channels[c].values[i] = static_cast<float>(mean[c]);
        }
    });
    return picture;
}

void write_outputs(const std::vector<std::string>& paths, const Picture& linear, const OutputStyle& style) {
    for (const std::string& path : paths) {
        const std::string extension = extension_of(path);
        if (is_linear_format(extension)) {
            const Picture picture = composited(linear, style);
            if (extension == ".hdr") {
                write_hdr(path, picture);
            } else if (const std::size_t saturated = write_exr(path, picture, style.half)) {
                warn(path + ": " + std::to_string(saturated) +
                     " values do not fit 16 bits and became 65504; leave out --half to keep them.");
            }
        } else if (path == "-") {
            write_standard_output(encode_picture(extension, encoded(linear, style)));
        } else {
            write_encoded(path, encoded(linear, style));
        }
    }
}

}  // namespace triad
