#include "app/reconstruct_options.h"

#include <algorithm>

#include "app/command_line.h"
#include "app/panel_file.h"

namespace triad {
namespace {

constexpr double usual_ppd = 45;  ///< a 27 inch display of 2560 x 1440 pixels at 0.6 m

}  // namespace

void declare(CLI::App& command, ReconstructOptions& o) {
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
        .add_option("--refine", o.refine_steps, "Steps of triad's bounded refinement (default 8; 0: none)")
        ->check(CLI::Range(0, 1000))
        ->type_name("N")
        ->group(group);
}

Reconstruction ReconstructOptions::make(std::optional<uvec2> film_bins) const {
    ReconstructionChoice choice{method, filter, bins ? bins : film_bins, {}, refine_steps};
    if (panel.empty() && (ppd || distance))
        throw Error(Exit::usage, "--ppd and --distance say how a display is seen: name it with --panel.");
    if (distance && !pitch)
        throw Error(Exit::usage, "--distance needs --pitch, the size of a pixel in the same unit.");
    if (!panel.empty()) {
        PanelView view{panel_named(panel), usual_ppd};
        view.ppd = distance ? pixels_per_degree(*distance, *pitch)
                            : ppd.value_or(view.panel.ppd.value_or(usual_ppd));
        choice.panel = view;
    }
    return reconstruction_of(choice);
}

}  // namespace triad
