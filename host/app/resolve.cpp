// triad resolve: pictures from a film, without rendering.
#include <memory>

#include "app/command_line.h"
#include "app/metadata.h"
#include "app/output.h"

namespace triad {
namespace {

struct ResolveOptions {
    std::string film, background, device;
    std::vector<std::string> outputs;
    OutputStyle style;
};

Exit run(ResolveOptions o) {
    for (const std::string& path : o.outputs) {
        check_format(path);
        check_writable(path);
    }
    if (!o.background.empty()) o.style.background = parse_colour("--background", o.background);
    const Film film = load_film(o.film);
    Device device = Device::open({.selector = o.device});
    write_outputs(o.outputs, device, film, o.style, {}, metadata_of(film));
    return Exit::done;
}

}  // namespace

void add_resolve(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<ResolveOptions>();
    CLI::App* command =
        app.add_subcommand("resolve", "Make pictures of a film again: other exposure, tone map, format");
    command->add_option("FILM", o->film, "Film file, of triad render --film or triad merge")
        ->required()
        ->type_name("");
    command->add_option("-o,--output", o->outputs, "Picture, as in triad render; several allowed")
        ->required()
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->group("Output");
    declare_style(*command, o->style);
    command->add_option("--background", o->background, "Put this colour behind what is transparent")
        ->type_name("#RRGGBB")
        ->group("Output");
    command->add_option("--device", o->device, "Number, cpu, gpu, or part of a name (see triad devices)")
        ->type_name("SEL");
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
