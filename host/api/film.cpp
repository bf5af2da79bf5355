#include "triad/film.h"

#include <algorithm>

#include "api/guard.h"
#include "api/inside.h"
#include "api/parse.h"
#include "api/pictures.h"
#include "base/check_outputs.h"
#include "base/error.h"
#include "base/log.h"
#include "session/metadata.h"
#include "session/resolve.h"

namespace triad::api {
namespace {

/// How a picture of the film is made with these options.
OutputStyle style_of(const Film::Inside& film, const Options& options) {
    if (options.empty() && film.is_chosen) return film.style;
    OutputStyle style = film.style;
    ReconstructRequest reconstruct = film.reconstruct;
    parse_picture_options(options, style, reconstruct);
    style.reconstruction = reconstruction_for(film.film, "at hand", reconstruct);
    if (style.denoise != Denoiser::off && !film.film.has_guides)
        inform(
            "The film holds nothing of what the camera sees first: colours alone guide the denoiser (render "
            "with option denoise, which keeps it).");
    return style;
}

triad::Device& device_of(const Film::Inside& film) {
    if (!film.device) film.device = triad::Device::open({.selector = film.selector});
    return *film.device;
}

Metadata metadata_with(const Film::Inside& film, const OutputStyle& style) {
    Metadata metadata = film.facts;
    describe(style.reconstruction, metadata);
    describe(style.denoise, metadata);
    return metadata;
}

}  // namespace

Film::Film(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

unsigned Film::width() const { return inside().film.width; }
unsigned Film::height() const { return inside().film.height; }
double Film::spp() const { return inside().film.sample_numbers().mean; }
bool Film::complete() const { return inside().complete; }

std::optional<double> Film::relmse() const {
    const double relmse = estimated_relmse(inside().film);
    return relmse < 0 ? std::nullopt : std::optional(relmse);
}

std::map<std::string, std::string> Film::metadata() const {
    return inside().is_chosen ? metadata_with(inside(), inside().style) : inside().facts;
}

const std::map<std::string, std::vector<float>>& Film::layers() const { return inside().layers; }

Image Film::image(const Options& options) const {
    return guarded([&] {
        const OutputStyle style = style_of(inside(), options);
        return image_of(linear_picture(device_of(inside()), inside().film, style));
    });
}

Bitmap Film::bitmap(const Options& options) const {
    return guarded([&]() -> Bitmap {
        const OutputStyle style = style_of(inside(), options);
        EncodedPicture picture = encoded_picture(device_of(inside()), inside().film, style);
        return {picture.width, picture.height, picture.channels, picture.bits, std::move(picture.bytes)};
    });
}

void Film::write(std::span<const std::filesystem::path> paths, const Options& options) const {
    guarded([&] {
        std::vector<std::string> names;
        for (const std::filesystem::path& path : paths) names.push_back(path.string());
        for (const std::string& name : names) check_format(name);
        check_outputs(names, {inside().reconstruct.panel});
        const OutputStyle style = style_of(inside(), options);
        check_format_for(style.reconstruction, names);
        std::vector<Channel> layers;
        for (const auto& [name, values] : inside().layers) layers.push_back({name, values});
        write_outputs(names, device_of(inside()), inside().film, style, std::move(layers),
                      metadata_with(inside(), style));
    });
}

void Film::write(const std::filesystem::path& path, const Options& options) const {
    write(std::span(&path, 1), options);
}

void Film::write(std::initializer_list<std::filesystem::path> paths, const Options& options) const {
    write(std::span(paths.begin(), paths.size()), options);
}

std::vector<std::uint8_t> Film::encode(const std::string& extension, const Options& options) const {
    return guarded([&] {
        check_format("picture" + extension);
        const OutputStyle style = style_of(inside(), options);
        check_format_for(style.reconstruction, {"picture" + extension});
        return encode_output(extension, device_of(inside()), inside().film, style,
                             metadata_with(inside(), style));
    });
}

void Film::save(const std::filesystem::path& path) const {
    guarded([&] { save_film(path, inside().film); });
}

Film load_film(const std::filesystem::path& path, const std::string& device) {
    return guarded([&] {
        Film::Inside inside;
        inside.film = triad::load_film(path);
        inside.facts = triad::metadata_of(inside.film);
        inside.complete = !inside.film.progress || inside.film.progress->ended;
        inside.selector = device;
        return Film(std::make_shared<const Film::Inside>(std::move(inside)));
    });
}

Film merge(const std::vector<Film>& films) {
    return guarded([&] {
        if (films.empty()) throw triad::Error(Exit::usage, "merge(): there are no films.");
        std::vector<triad::Film> parts;
        for (const Film& film : films) parts.push_back(film.inside().film);
        const Film::Inside& first = films.front().inside();
        Film::Inside inside;
        inside.film = triad::merge(parts);
        inside.facts = triad::metadata_of(inside.film);
        inside.style = first.style, inside.is_chosen = first.is_chosen;
        inside.reconstruct = first.reconstruct;
        inside.selector = first.selector, inside.device = first.device;
        inside.complete = std::all_of(films.begin(), films.end(), [](const Film& f) { return f.complete(); });
        return Film(std::make_shared<const Film::Inside>(std::move(inside)));
    });
}

}  // namespace triad::api
