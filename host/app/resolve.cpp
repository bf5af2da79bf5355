// triad resolve: pictures from a film or a linear picture, without rendering.
#include <memory>

#include "app/command_line.h"
#include "app/metadata.h"
#include "app/output.h"
#include "base/log.h"

namespace triad {
namespace {

struct ResolveOptions {
    std::string input, background;
    std::vector<std::string> outputs;
    OutputStyle style;
};

Picture load(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".exr" || extension == ".hdr") return read_picture(path);
    const Film film = load_film(path);
    Picture picture = linear_picture(film, has_alpha(film));
    picture.metadata = metadata_of(film);
    return picture;
}

Exit run(ResolveOptions o) {
    for (const std::string& path : o.outputs) {
        check_format(path);
        check_writable(path);
    }
    if (!o.background.empty()) o.style.background = parse_colour("--background", o.background);
    write_outputs(o.outputs, load(o.input), o.style);
    return Exit::done;
}

}  // namespace

void add_resolve(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<ResolveOptions>();
    CLI::App* command =
        app.add_subcommand("resolve", "Make pictures of a film again: other exposure, tone map, format");
    command->add_option("FILM", o->input, "Film file, or a linear picture (.exr, .hdr)")
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
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
