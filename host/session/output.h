#pragma once
/// Pictures out: from a film to files, by their extension.
#include <optional>
#include <string>
#include <vector>

#include "device/device.h"
#include "display/denoise.h"
#include "display/reconstruction.h"
#include "io/io.h"
#include "scene/film.h"

namespace triad {

/// How a film becomes pictures.
struct OutputStyle {
    double exposure = 0;              ///< EV: radiance is multiplied by 2^exposure before the tone map
    bool automatic_exposure = false;  ///< automatic_exposure() of the picture in its place
    std::string tone_map = "khronos";
    std::optional<vec3> background;  ///< linear; put behind everything that is transparent
    Reconstruction reconstruction;   ///< EXR and HDR hold what a display shows where it says so
    unsigned bits = 8;               ///< of PNG
    bool half = false;               ///< of EXR
    Denoiser denoise = Denoiser::off;
};

/// Loads what these pictures need to be written: before a long work, not after it. Throws Error(scene),
/// Error(memory).
void prepare_to_write(const std::vector<std::string>& paths);

/// In lower case, with its dot; of "-" (standard output) ".png".
std::string picture_extension(const std::string& path);
bool is_exr(const std::string& path);
/// Whether files of that extension hold radiance, before any tone map.
bool is_linear_format(const std::string& extension);
/// Whether the extension is that of a picture.
bool is_picture(const std::string& path);
/// Throws Error(usage) when `path` ("-" is standard output, as PNG) has no extension of a picture.
void check_format(const std::string& path);
/// What only files that can say so may hold: Throws Error(usage) for drives of a panel in a .hdr file.
void check_format_for(const Reconstruction& method, const std::vector<std::string>& paths);
/// The part of the way to pixels that the style decides.
DisplaySettings display_settings(const OutputStyle& style, bool alpha);

/// The style with the exposure that it has for this film.
OutputStyle exposed(OutputStyle style, const Film& film);

/// What a PNG shows before the sRGB curve: tone-mapped RGBA, on the background where there is one.
std::vector<float> display_of(Device& device, const Film& film, const OutputStyle& style);
/// What an EXR holds: scene-linear RGBA, or what a display shows.
std::vector<float> linear_of(Device& device, const Film& film, const OutputStyle& style);

/// The values of an EXR file, without metadata.
Picture linear_picture(Device& device, const Film& film, const OutputStyle& style);
Picture linear_picture(Device& device, const BinImage& image, bool alpha, const OutputStyle& style);
/// Those of a PNG file.
EncodedPicture encoded_picture(Device& device, const Film& film, const OutputStyle& style);

/// Writes the film to each path in the form that its extension asks for. `layers` go into EXR files,
/// `metadata` into all. Where the film has alpha and the style no background colour, formats that can keep
/// alpha do.
void write_outputs(const std::vector<std::string>& paths, Device& device, const Film& film,
                   const OutputStyle& style, std::vector<Channel> layers, const Metadata& metadata);

/// What write_outputs() would write to a file with this extension (".png", ".exr", ...), without layers.
std::vector<std::uint8_t> encode_output(const std::string& extension, Device& device, const Film& film,
                                        const OutputStyle& style, const Metadata& metadata);

/// The same from any picture's bins, `name` for messages. Formats of linear values hold what a display shows
/// where the bins are tone-mapped already.
void write_outputs(const std::vector<std::string>& paths, Device& device, const BinImage& image, bool alpha,
                   const OutputStyle& style, const Metadata& metadata);

}  // namespace triad
