// triad view: a page that shows a picture while it grows.
#include "viewer/view.h"

#include <memory>

#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/output_options.h"
#include "cli/render_options.h"
#include "cli/resume.h"

namespace triad {
namespace {

/// What a view says anew of the picture that it shows, and what is of the view alone.
const std::vector<std::string> of_view{"--look-at",    "--orbit",   "--camera",   "--fov",     "--size",
                                       "--crop",       "--variant", "--exposure", "--tonemap", "--port",
                                       "--no-browser", "--verbose", "--quiet"};
/// How samples become pixels.
const std::vector<std::string> of_display{"--panel", "--bins",     "--reconstruct", "--filter",
                                          "--ppd",   "--distance", "--pitch",       "--refine"};

std::string command_to_copy(const CLI::App& command, const std::vector<std::string>& options,
                            bool keeps_display) {
    std::vector<std::string> without = of_view;
    if (!keeps_display) without.insert(without.end(), of_display.begin(), of_display.end());
    return command_of(command, without, options);
}

}  // namespace

void add_view(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<ViewRequest>();
    auto no_browser = std::make_shared<bool>(false);
    CLI::App* command =
        app.add_subcommand("view", "Look at a scene in a browser while it is rendered, and around in it");
    declare_workload(*command, o->render);
    declare_style(*command, o->render.style);
    command->get_option("--spp")->description(
        "Samples per pixel, after which the picture stays as it is (default: none). Of --spp, --error and "
        "--time, what is reached first ends it");
    // What a view refuses, with a sentence.
    for (const char* refused : {"--samples", "--pixel", "--denoise"}) command->get_option(refused)->group("");
    const char* const group = "Page";
    command->add_option("--port", o->port, "Of 127.0.0.1, where the page is (default: any that is free)")
        ->check(whole_number_within(0, 65535))
        ->type_name("N")
        ->group(group);
    command->add_flag("--no-browser", *no_browser, "Print the page's address, and open no browser")
        ->group(group);
    command->callback([o, no_browser, command, &exit] {
        o->open_browser = !*no_browser;
        o->render.words = words_of_picture(*command);
        o->command = [command](const std::vector<std::string>& options, bool keeps_display) {
            return command_to_copy(*command, options, keeps_display);
        };
        exit = view(*o);
    });
}

}  // namespace triad
