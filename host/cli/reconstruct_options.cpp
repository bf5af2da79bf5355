#include "cli/reconstruct_options.h"

#include <algorithm>

#include "cli/command_line.h"
#include "session/panel_file.h"

namespace triad {
void declare(CLI::App& command, ReconstructRequest& o) {
    const char* const group = "Reconstruction";
    std::string names;
    for (const MethodWords& method : reconstruction_methods())
        names += (names.empty() ? "" : ", ") + method.name;
    command
        .add_option("--reconstruct", o.method,
                    "How samples become pixels: " + names +
                        " (default: triad with --panel, filter with --filter, else the mean of the bins)")
        ->type_name("NAME")
        ->group(group);
    command
        .add_option_function<std::string>(
            "--bins",
            [&o](const std::string& v) {
                o.bins = parse_size("--bins", v);
                if (std::max(o.bins->x, o.bins->y) > 16)
                    throw Error(Exit::usage, "--bins " + v + ": at most 16x16.");
            },
            "Bins of the film per pixel (default: what the method has, else 1x1)")
        ->type_name("BXxBY")
        ->group(group);
    command
        .add_option_function<std::string>(
            "--filter", [&o](const std::string& v) { o.filter = parse_filter(v); },
            "box, tent, gaussian, mitchell, catmull-rom, lanczos or blackman-harris, and its width in pixels")
        ->type_name("NAME[:WIDTH]")
        ->group(group);
    command
        .add_option("--panel", o.panel,
                    "Make the picture for this display, and no other: see triad panel (default: for any)")
        ->type_name("NAME|FILE.json")
        ->group(group);
    CLI::Option* ppd =
        command
            .add_option("--ppd", o.ppd,
                        "Pixels per degree of the display as it is seen (default: the panel's, or 45)")
            ->check(number_within(5, 1000))
            ->type_name("P")
            ->group(group);
    CLI::Option* distance =
        command.add_option("--distance", o.distance, "Instead of --ppd: from the eye to the display")
            ->check(number_within(1e-9, 1e9))
            ->excludes(ppd)
            ->type_name("D")
            ->group(group);
    command.add_option("--pitch", o.pitch, "With --distance: of its pixels, in the same unit")
        ->check(number_within(1e-9, 1e9))
        ->needs(distance)
        ->type_name("D")
        ->group(group);
    command
        .add_option("--refine", o.refine_steps, "Steps of triad's bounded refinement (default 5; 0: none)")
        ->check(CLI::Range(0, 1000))
        ->type_name("N")
        ->group(group);
}

}  // namespace triad
