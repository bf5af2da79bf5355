#include "session/output.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "display/exposure.h"
#include "display/resolve.h"
#include "session/metadata.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

/// What outputs are made of; each form is made when it is first asked for.
struct Source {
    Picture window;      ///< sizes only
    bool alpha = false;  ///< keep it where the format can
    std::function<std::vector<float>()> linear, display;
    bool linear_is_display = false;
    std::vector<Channel> layers;  ///< of EXR files
};

EncodedPicture encoded(const Source& source, const OutputStyle& style) {
    const std::vector<float> rgba = source.display();
    const unsigned channels = source.alpha ? 4 : 3;
    return {source.window.width,
            source.window.height,
            channels,
            style.bits,
            encode_srgb(rgba, channels, style.bits),
            {}};
}

/// R, G, B and, where it means something, A (RGB associated).
Picture linear(const Source& source) {
    const std::vector<float> rgba = source.linear();
    Picture picture = source.window;
    const char* const names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < (source.alpha ? 4 : 3); ++c) {
        Channel channel{names[c], std::vector<float>(rgba.size() / 4)};
        for (std::size_t i = 0; i < channel.values.size(); ++i) channel.values[i] = rgba[4 * i + c];
        picture.channels.push_back(std::move(channel));
    }
    return picture;
}

void write_standard_output(const std::vector<std::uint8_t>& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        throw Error(Exit::scene, "Cannot write the picture to standard output: it is closed or full.");
}

}  // namespace

std::string picture_extension(const std::string& path) {
    if (path == "-") return ".png";
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

bool is_linear_format(const std::string& extension) { return extension == ".exr" || extension == ".hdr"; }

bool is_exr(const std::string& path) { return picture_extension(path) == ".exr"; }

void prepare_to_write(const std::vector<std::string>& paths) {
    for (const std::string& path : paths)
        if (const std::string extension = picture_extension(path); extension != ".png" && extension != ".exr")
            load_picture_formats();
}

bool is_picture(const std::string& path) {
    const std::string extension = picture_extension(path);
    for (const char* known : {".exr", ".hdr", ".png", ".jpg", ".jpeg"})
        if (extension == known) return true;
    return false;
}

void check_format(const std::string& path) {
    if (is_picture(path)) return;
    throw Error(
        Exit::usage,
        "-o " + path + ": the extension must be .exr, .hdr, .png or .jpg (or - for PNG on standard output).");
}

void check_format_for(const Reconstruction& method, const std::vector<std::string>& paths) {
    for (const std::string& path : paths)
        if (method.panel && picture_extension(path) == ".hdr")
            throw Error(Exit::usage,
                        "-o " + path +
                            ": .hdr files cannot say which panel they were made for, and on others "
                            "they are wrong. Give .exr or .png, or leave --panel out.");
}

DisplaySettings display_settings(const OutputStyle& style, bool alpha) {
    static const std::map<std::string, ToneMap> maps = {{"none", ToneMap::none},
                                                        {"aces", ToneMap::aces},
                                                        {"agx", ToneMap::agx},
                                                        {"khronos", ToneMap::khronos}};
    DisplaySettings settings;
    settings.exposure_ev = static_cast<float>(style.exposure);
    settings.tone_map = maps.at(style.tone_map);
    settings.background = style.background;
    settings.alpha = alpha;
    apply(style.reconstruction, settings);
    return settings;
}

OutputStyle exposed(OutputStyle style, const Film& film) {
    if (style.automatic_exposure) style.exposure = automatic_exposure(film), style.automatic_exposure = false;
    return style;
}

std::vector<float> display_of(Device& device, const Film& film, const OutputStyle& style) {
    return resolve_display(device, film, display_settings(style, has_alpha(film)));
}

std::vector<float> linear_of(Device& device, const Film& film, const OutputStyle& style) {
    if (style.reconstruction.display_linear()) return display_of(device, film, style);
    std::vector<float> rgba;
    if (style.reconstruction.taps) {
        DisplaySettings settings = display_settings(style, has_alpha(film));
        settings.order = ToneOrder::never;
        settings.exposure_ev = 0, settings.background.reset();
        rgba = resolve_display(device, film, settings);
    } else {
        rgba = resolve_linear(film);
    }
    if (style.background) put_on_background(rgba, *style.background);
    return rgba;
}

namespace {

/// With what was applied to values that are shown.
Metadata of_display(Metadata metadata, const OutputStyle& style) {
    if (style.exposure != 0) metadata["triad:exposure"] = format("%g", style.exposure);
    return metadata;
}
Picture linear(const Source& source, const OutputStyle& style, const Metadata& metadata) {
    Picture picture = linear(source);
    picture.metadata = metadata;
    if (source.linear_is_display) {
        picture.metadata = of_display(metadata, style);
        picture.metadata["triad:values"] = "display-linear";
    }
    return picture;
}
EncodedPicture encoded(const Source& source, const OutputStyle& style, const Metadata& metadata) {
    EncodedPicture picture = encoded(source, style);
    picture.metadata = of_display(metadata, style);
    return picture;
}
void tell_exposure(const OutputStyle& style) {
    inform(format("Exposure %+.1f EV, from the picture's mean luminance", style.exposure));
}

void write_all(const std::vector<std::string>& paths, Source source, const OutputStyle& style,
               const Metadata& metadata) {
    std::optional<Picture> linear_picture;
    std::optional<EncodedPicture> display;
    for (const std::string& path : paths) {
        const std::string extension = picture_extension(path);
        if (is_linear_format(extension)) {
            if (!linear_picture) {
                linear_picture = linear(source, style, metadata);
                std::move(source.layers.begin(), source.layers.end(),
                          std::back_inserter(linear_picture->channels));
            }
            if (extension == ".hdr") {
                write_hdr(path, *linear_picture);
            } else if (const std::size_t saturated = write_exr(path, *linear_picture, style.half)) {
                warn(path + ": " + std::to_string(saturated) +
                     " values do not fit 16 bits and became 65504; leave out --half to keep them.");
            }
            continue;
        }
        if (!display) display = encoded(source, style, metadata);
        if (path == "-")
            write_standard_output(encode_picture(extension, *display));
        else
            write_encoded(path, *display);
    }
}

Source source_of(Device& device, const std::shared_ptr<const BinImage>& image, bool alpha,
                 const OutputStyle& style) {
    const bool shown = image->encoded || style.reconstruction.display_linear();
    const auto resolve = [&device, image, alpha, style, shown](bool linear) {
        DisplaySettings settings = display_settings(style, alpha);
        if (linear && !shown) {
            settings.order = ToneOrder::never;
            settings.exposure_ev = 0, settings.background.reset();
        }
        std::vector<float> rgba = resolve_display(device, *image, settings);
        if (linear && !shown && style.background) put_on_background(rgba, *style.background);
        return rgba;
    };
    Source source;
    source.window.width = source.window.full_width = image->width();
    source.window.height = source.window.full_height = image->height();
    source.alpha = alpha && !style.background && !style.reconstruction.panel;
    source.linear = [resolve] { return resolve(true); };
    source.display = [resolve] { return resolve(false); };
    source.linear_is_display = shown;
    return source;
}

/// The caller keeps it.
std::shared_ptr<const BinImage> borrowed(const BinImage& image) {
    return {&image, [](const BinImage*) {}};
}

/// An encoded picture is exposed already.
OutputStyle exposed(OutputStyle style, const BinImage& image) {
    if (style.automatic_exposure && !image.encoded)
        style.exposure = automatic_exposure(image.rgba, image.columns), style.automatic_exposure = false;
    return style;
}

/// The film and the device must live as long.
Source source_of(Device& device, const Film& film, const OutputStyle& asked) {
    const OutputStyle style = exposed(asked, film);
    Source source;
    if (style.denoise != Denoiser::off) {
        source = source_of(device, std::make_shared<const BinImage>(denoised(device, film, style.denoise)),
                           has_alpha(film), style);
    } else {
        source.alpha = has_alpha(film) && !style.background && !style.reconstruction.panel;
        source.linear = [&device, &film, style] { return linear_of(device, film, style); };
        source.display = [&device, &film, style] { return display_of(device, film, style); };
        source.linear_is_display = style.reconstruction.display_linear();
    }
    source.window.width = film.width, source.window.height = film.height;
    source.window.x = film.x, source.window.y = film.y;
    source.window.full_width = film.full_width, source.window.full_height = film.full_height;
    return source;
}

}  // namespace

void write_outputs(const std::vector<std::string>& paths, Device& device, const Film& film,
                   const OutputStyle& asked, std::vector<Channel> layers, const Metadata& metadata) {
    const OutputStyle style = exposed(asked, film);
    if (asked.automatic_exposure) tell_exposure(style);
    Source source = source_of(device, film, style);
    source.layers = std::move(layers);
    write_all(paths, std::move(source), style, metadata);
}

Picture linear_picture(Device& device, const Film& film, const OutputStyle& style) {
    return linear(source_of(device, film, style));
}

Picture linear_picture(Device& device, const BinImage& image, bool alpha, const OutputStyle& style) {
    return linear(source_of(device, borrowed(image), alpha, exposed(style, image)));
}

EncodedPicture encoded_picture(Device& device, const Film& film, const OutputStyle& style) {
    return encoded(source_of(device, film, style), style);
}

std::vector<std::uint8_t> encode_output(const std::string& extension, Device& device, const Film& film,
                                        const OutputStyle& asked, const Metadata& metadata) {
    const OutputStyle style = exposed(asked, film);
    const Source source = source_of(device, film, style);
    if (!is_linear_format(extension)) return encode_picture(extension, encoded(source, style, metadata));
    const Picture picture = linear(source, style, metadata);
    return extension == ".hdr" ? encode_hdr(picture) : encode_exr(picture, style.half);
}

void write_outputs(const std::vector<std::string>& paths, Device& device, const BinImage& image, bool alpha,
                   const OutputStyle& asked, const Metadata& metadata) {
    const OutputStyle style = exposed(asked, image);
    if (asked.automatic_exposure && !style.automatic_exposure) tell_exposure(style);
    write_all(paths, source_of(device, borrowed(image), alpha, style), style, metadata);
}

}  // namespace triad
