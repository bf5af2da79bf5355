#include "cli/output_options.h"

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

}  // namespace

void declare_style(CLI::App& command, OutputStyle& style) {
    command.add_option("--exposure", style.exposure, "In EV, for tone-mapped outputs (default 0)")
        ->check(number_within(-64, 64))
        ->type_name("EV")
        ->group(output_group);
    command.add_option("--tonemap", style.tone_map, "none, aces, agx or khronos (the default: PBR Neutral)")
        ->check(CLI::IsMember({"none", "aces", "agx", "khronos"}))
        ->type_name("NAME")
        ->group(output_group);
    command.add_option("--bits", style.bits, "Of PNG outputs, 8 or 16 (default 8)")
        ->check(CLI::IsMember({8, 16}))
        ->type_name("N")
        ->group(output_group);
    add_parsed(
        command, "--denoise", "NAME",
        "off (the default), own (on the device, guided by what the camera sees first) or oidn (Intel's Open "
        "Image Denoise, where it is installed)",
        [&style](const std::string& v) { style.denoise = denoiser_named(v); })
        ->group(output_group);
    command.add_flag("--half", style.half, "16-bit EXR instead of 32-bit")->group(output_group);
}

void declare_background(CLI::App& command, OutputStyle& style) {
    add_parsed(command, "--background", "#RRGGBB", "Put this colour behind what is transparent",
               [&style](const std::string& v) { style.background = parse_colour("--background", v); })
        ->group(output_group);
}

void declare_outputs(CLI::App& command, RenderRequest& o) {
    declare_frames(command, o);
    command
        .add_option("-o,--output", o.outputs,
                    "Picture: .exr, .hdr (linear), .png, .jpg (tone-mapped), - (PNG on standard output); "
                    "several allowed")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->group(output_group);
    declare_style(command, o.style);
    command
        .add_option("--aov", o.aovs,
                    "Layers for EXR files: albedo, normal, position, depth, samples, variance, error, or all")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(
            CLI::IsMember({"albedo", "normal", "position", "depth", "samples", "variance", "error", "all"}))
        ->type_name("LIST")
        ->group(output_group);
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
    command.add_option("--json", o.json_path, "Write times, rays and errors as JSON")
        ->type_name("FILE")
        ->group(output_group);
    command.add_option("--progress", o.progress, "On standard error: auto, bar, lines, json or none")
        ->check(CLI::IsMember({"auto", "bar", "lines", "json", "none"}))
        ->type_name("STYLE")
        ->group(output_group);
}

}  // namespace triad
