#include "app/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>

#include "app/metadata.h"
#include "base/error.h"
#include "base/log.h"
#include "render/resolve.h"

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

/// Exposure, tone map, background, sRGB curve.
EncodedPicture encoded(Device& device, const Film& film, const OutputStyle& style) {
    const std::vector<float> rgba = display_of(device, film, style);
    const unsigned channels = has_alpha(film) && !style.background ? 4 : 3;
    return {film.width, film.height, channels, style.bits, encode_srgb(rgba, channels, style.bits), {}};
}

/// R, G, B and, where it means something, A (RGB associated).
Picture linear(const Film& film, const OutputStyle& style) {
    std::vector<float> rgba = resolve_linear(film);
    if (style.background) put_on_background(rgba, *style.background);
    Picture picture{film.width, film.height, film.x, film.y, film.full_width, film.full_height, {}, {}};
    const char* const names[] = {"R", "G", "B", "A"};
    for (int c = 0; c < (has_alpha(film) && !style.background ? 4 : 3); ++c) {
        Channel channel{names[c], std::vector<float>(film.pixels())};
        for (std::size_t i = 0; i < film.pixels(); ++i) channel.values[i] = rgba[4 * i + c];
        picture.channels.push_back(std::move(channel));
    }
    return picture;
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

bool is_linear(const std::string& path) { return is_linear_format(extension_of(path)); }

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
    const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) throw Error(Exit::scene, "Cannot write " + path + ": " + std::strerror(errno) + ".");
    ::close(file);
    fs::remove(probe);
}

std::vector<float> display_of(Device& device, const Film& film, const OutputStyle& style) {
    static const std::map<std::string, ToneMap> maps = {{"none", ToneMap::none},
                                                        {"aces", ToneMap::aces},
                                                        {"agx", ToneMap::agx},
                                                        {"khronos", ToneMap::khronos}};
    std::vector<float> rgba =
        resolve_display(device, film, {static_cast<float>(style.exposure), maps.at(style.tone_map)});
    if (style.background) put_on_background(rgba, *style.background);
    return rgba;
}

void write_outputs(const std::vector<std::string>& paths, Device& device, const Film& film,
                   const OutputStyle& style, std::vector<Channel> layers, const Metadata& metadata) {
    std::optional<Picture> scene_linear;
    std::optional<EncodedPicture> display;
    for (const std::string& path : paths) {
        const std::string extension = extension_of(path);
        if (is_linear_format(extension)) {
            if (!scene_linear) {
                scene_linear = linear(film, style);
                scene_linear->metadata = metadata;
                std::move(layers.begin(), layers.end(), std::back_inserter(scene_linear->channels));
            }
            if (extension == ".hdr") {
                write_hdr(path, *scene_linear);
            } else if (const std::size_t saturated = write_exr(path, *scene_linear, style.half)) {
                warn(path + ": " + std::to_string(saturated) +
                     " values do not fit 16 bits and became 65504; leave out --half to keep them.");
            }
            continue;
        }
        if (!display) {
            display = encoded(device, film, style);
            display->metadata = metadata;
        }
        if (path == "-")
            write_standard_output(encode_picture(extension, *display));
        else
            write_encoded(path, *display);
    }
}

}  // namespace triad
