#include "cli/output_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/log.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/render_options.h"

namespace triad {

namespace {

const char* const output_group = "Output";

void declare_frames(CLI::App& command, RenderRequest& o) {
    CLI::Option* frames =
        add_parsed(
            command, "--frames", "A:B",
            "A picture of each of these frames (half-open; frame k is at k / --fps seconds): a.png becomes "
            "a.0001.png, and films and JSON alike",
            [&o](const std::string& v) { o.frames = parse_range("--frames", v); })
            ->group(output_group);
    command.add_option("--fps", o.fps, "Frames in a second (default 24)")
        ->check(number_within(1e-6, 1e6))
        ->type_name("F")
        ->needs(frames)
        ->group(output_group);
}

void parse_exposure(const std::string& text, OutputStyle& style) {
    style.automatic_exposure = text == "auto";
    if (style.automatic_exposure) return;
    const char *begin = text.data() + (text[0] == '+'), *end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(begin, end, style.exposure);
    if (error != std::errc() || rest != end || !(std::abs(style.exposure) <= 64))
        throw Error(Exit::usage, "--exposure " + text + ": auto, or a number from -64 to 64.");
}

}  // namespace

void declare_style(CLI::App& command, OutputStyle& style) {
    add_parsed(
        command, "--exposure", "auto|EV",
        "Of tone-mapped outputs, in powers of two (default 0); auto: the picture's mean becomes a mid grey",
        [&style](const std::string& v) { parse_exposure(v, style); })
        ->group(output_group);
    add_word(command, "--tonemap", "Of tone-mapped outputs (default khronos: its PBR Neutral)",
             {"none", "aces", "agx", "khronos"}, style.tone_map)
        ->group(output_group);
    command.add_option("--bits", style.bits, "Of PNG outputs (default 8)")
        ->check(CLI::IsMember({8, 16}))
        ->type_name("8|16")
        ->group(output_group);
    add_parsed(
        command, "--denoise", "off|own|oidn",
        "Less noise than the samples have. off: the default; own: on the device, guided by what the camera "
        "sees first; oidn: Intel's Open Image Denoise, where it is installed, for whole pixels",
        [&style](const std::string& v) { style.denoise = denoiser_named(v); })
        ->group(output_group);
    command.add_flag("--half", style.half, "16-bit EXR instead of 32-bit")->group(output_group);
}

void warn_of_idle(const OutputStyle& style, const std::vector<std::string>& outputs) {
    if (outputs.empty()) return;
    const auto any = [&](bool (*is_such)(const std::string& extension)) {
        return std::ranges::any_of(outputs,
                                   [&](const std::string& path) { return is_such(picture_extension(path)); });
    };
    const bool toned = style.automatic_exposure || style.exposure != 0 || style.tone_map != "khronos";
    const bool all_linear = std::ranges::all_of(
        outputs, [](const std::string& path) { return is_linear_format(picture_extension(path)); });
    if (toned && all_linear && !style.reconstruction.display_linear())
        warn("--exposure and --tonemap change nothing here: .exr and .hdr hold radiance.");
    if (style.bits != 8 && !any([](const std::string& e) { return e == ".png"; }))
        warn("--bits changes nothing here: it is for .png.");
    if (style.half && !any([](const std::string& e) { return e == ".exr"; }))
        warn("--half changes nothing here: it is for .exr.");
}

void declare_background(CLI::App& command, OutputStyle& style) {
    add_parsed(command, "--background", "#RRGGBB", "Put this colour behind what is transparent",
               [&style](const std::string& v) { style.background = parse_colour("--background", v); })
        ->group(output_group);
}

void declare_outputs(CLI::App& command, RenderRequest& o) {
    command
        .add_option("-o,--output", o.outputs,
                    "Picture: .exr, .hdr (linear), .png, .jpg (tone-mapped), - (PNG on standard output); "
                    "several allowed. %s in a name is the scene's, as several scenes need it")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->group(output_group);
    declare_style(command, o.style);
    add_word_list(command, "--aov", "Layers for EXR files",
                  {"albedo", "normal", "position", "depth", "samples", "variance", "error", "all"}, o.aovs)
        ->group(output_group);
    declare_frames(command, o);
    command
        .add_option("--film", o.film_path,
                    "Also write the film, now and then while rendering: for --resume, triad merge and triad "
                    "resolve")
        ->type_name("FILE")
        ->group(output_group);
    command
        .add_option(
            "--resume", o.resume_path,
            "Go on from this film, with the scene and the options that it was begun with; the film is "
            "written to it, or to --film")
        ->type_name("FILM")
        ->group(output_group);
    command
        .add_option("--checkpoint", o.checkpoint,
                    "Seconds between two films that are written while rendering (default 60, or more where "
                    "writing takes long)")
        ->check(number_within(0, 1e9))
        ->type_name("S")
        ->group(output_group);
    add_json(command, o.json_path, "Write times, rays and errors")->group(output_group);
    add_progress(command, o.progress)->group(output_group);
}

}  // namespace triad
