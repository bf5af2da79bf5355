// triad resolve: pictures from a film or from any renderer's larger picture, without rendering.
#include <memory>

#include "base/check_outputs.h"
#include "base/log.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/output_options.h"
#include "cli/reconstruct_options.h"
#include "session/metadata.h"
#include "session/output.h"
#include "session/resolve.h"

namespace triad {
namespace {

struct ResolveOptions {
    std::string source, device;
    std::vector<std::string> outputs;
    OutputStyle style;
    ReconstructRequest reconstruct;
    bool toned = false;  ///< --exposure or --tonemap was given
};

/// Of what changes nothing.
void warn_of_idle(const ResolveOptions& o, bool alpha) {
    warn_of_idle(o.style, o.outputs);
    if (o.style.background && !alpha)
        warn("--background changes nothing here: nothing in " + o.source + " is transparent.");
}

void resolve_film(ResolveOptions& o) {
    const Film film = load_film(o.source);
    o.style.reconstruction = reconstruction_for(film, o.source, o.reconstruct);
    warn_of_idle(o, has_alpha(film));
    check_format_for(o.style.reconstruction, o.outputs);
    Device device = Device::open({.selector = o.device});
    Metadata metadata = metadata_of(film);
    describe(o.style.reconstruction, metadata);
    describe(o.style.denoise, metadata);
    if (o.style.denoise != Denoiser::off && !film.has_guides)
        inform(
            "The film holds nothing of what the camera sees first: colours alone guide the denoiser (triad "
            "render "
            "--denoise keeps it).");
    write_outputs(o.outputs, device, film, o.style, {}, metadata);
}

void resolve_image(ResolveOptions& o) {
    if (o.style.denoise != Denoiser::off)
        throw Error(Exit::usage,
                    "--denoise is for films, which know their noise; " + o.source + " is a picture.");
    const Picture picture = read_picture(o.source);
    refuse_for_panel(o.source, picture.metadata, "filter");
    if (picture.encoded && o.toned)
        throw Error(Exit::usage,
                    o.source +
                        " holds sRGB values that are tone-mapped already: --exposure and --tonemap "
                        "are for films and for EXR and HDR pictures.");
    o.style.reconstruction = reconstruction_for_pictures(o.reconstruct);
    check_format_for(o.style.reconstruction, o.outputs);
    const Reconstruction& method = o.style.reconstruction;
    const bool alpha = picture.find("A") != nullptr;
    warn_of_idle(o, alpha);
    const BinImage image = bins_of(picture, o.source, method);
    Device device = Device::open({.selector = o.device});
    Metadata metadata = {{"triad:version", TRIAD_VERSION}, {"Software", "triad " TRIAD_VERSION}};
    describe(method, metadata);
    write_outputs(o.outputs, device, image, alpha, o.style, metadata);
}

Exit run(ResolveOptions o) {
    for (const std::string& path : o.outputs) check_format(path);
    check_outputs(o.outputs, {o.source, o.reconstruct.panel});
    if (is_film(o.source))
        resolve_film(o);
    else
        resolve_image(o);
    return Exit::done;
}

}  // namespace

void add_resolve(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<ResolveOptions>();
    CLI::App* command = app.add_subcommand(
        "resolve",
        "Make pictures of a film again, or of any larger picture: for a panel, by a filter, other tones");
    command
        ->add_option(
            "FILM|IMAGE", o->source,
            "Film of triad render --film or triad merge; or a picture of any renderer (EXR, HDR, PNG, "
            "JPEG), whose pixels are the bins")
        ->required()
        ->type_name("");
    command->add_option("-o,--output", o->outputs, "Picture, as in triad render; several allowed")
        ->required()
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->group("Output");
    declare_style(*command, o->style);
    declare(*command, o->reconstruct);
    declare_background(*command, o->style);
    add_device(*command, o->device)->group("Machine");
    command->callback([o, command, &exit] {
        o->toned = command->count("--exposure") + command->count("--tonemap") > 0;
        exit = run(*o);
    });
}

}  // namespace triad
