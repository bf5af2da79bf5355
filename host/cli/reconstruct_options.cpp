#include "cli/reconstruct_options.h"

#include <algorithm>

#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "session/panel_file.h"

namespace triad {
void declare(CLI::App& command, ReconstructRequest& o) {
    const char* const group = "Reconstruction";
    std::string names;
    for (const MethodWords& method : reconstruction_methods())
        names += (names.empty() ? "" : ", ") + method.name;
    add_parsed(command, "--reconstruct", "NAME",
               "How samples become pixels: " + names +
                   " (default: triad with --panel, filter with --filter, else the mean of the bins)",
               [&o](const std::string& v) {
                   method_named(v);
                   o.method = v;
               })
        ->group(group);
    add_parsed(command, "--bins", "BXxBY",
               "Bins of the film per pixel (default: what the method has, else 1x1)",
               [&o](const std::string& v) {
                   o.bins = parse_size("--bins", v);
                   if (std::max(o.bins->x, o.bins->y) > 16)
                       throw Error(Exit::usage, "--bins " + v + ": at most 16x16.");
               })
        ->group(group);
    add_parsed(
        command, "--filter", "NAME[:WIDTH]",
        "box, tent, gaussian, mitchell, catmull-rom, lanczos or blackman-harris, and its width in pixels",
        [&o](const std::string& v) { o.filter = parse_filter(v); })
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
        ->check(whole_number_within(0, 1000))
        ->type_name("N")
        ->group(group);
}

}  // namespace triad
