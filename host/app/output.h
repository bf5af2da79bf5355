#pragma once
/// Pictures out: from a film to files, by their extension.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "device/device.h"
#include "io/io.h"
#include "scene/film.h"

namespace triad {

/// How a film becomes pictures for looking at; EXR and HDR files stay scene-linear.
struct OutputStyle {
    double exposure = 0;  ///< EV: radiance is multiplied by 2^exposure before the tone map
    std::string tone_map = "khronos";
    std::optional<vec3> background;  ///< linear; put behind everything that is transparent
    unsigned bits = 8;               ///< of PNG
    bool half = false;               ///< of EXR
};

/// Declares --exposure, --tonemap, --bits and --half.
void declare_style(CLI::App& command, OutputStyle& style);

bool is_exr(const std::string& path);
/// Whether the extension is that of a format of linear values.
bool is_linear(const std::string& path);
/// Throws Error(usage) when `path` ("-" is standard output, as PNG) has no extension of a picture.
void check_format(const std::string& path);
/// Throws Error(scene) when no file can be made at `path`: to be asked before a long render, not after.
void check_writable(const std::string& path);

/// What a PNG shows before the sRGB curve: tone-mapped RGBA, on the background where there is one.
std::vector<float> display_of(Device& device, const Film& film, const OutputStyle& style);

/// Writes the film to each path in the form that its extension asks for. `layers` go into EXR files,
/// `metadata` into all. Where the film has alpha and the style no background colour, formats that can keep
/// alpha do.
void write_outputs(const std::vector<std::string>& paths, Device& device, const Film& film,
                   const OutputStyle& style, std::vector<Channel> layers, const Metadata& metadata);

}  // namespace triad
