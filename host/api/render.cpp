#include "triad/render.h"

#include <algorithm>

#include "api/guard.h"
#include "api/inside.h"
#include "api/kept_devices.h"
#include "api/parse.h"
#include "base/error.h"
#include "session/render_session.h"

namespace triad::api {
namespace {

/// All of them by their names.
Options options_of(const Settings& settings) {
    Options options = settings.options;
    if ((settings.width == 0) != (settings.height == 0))
        throw triad::Error(Exit::usage, "A picture needs width and height, or neither.");
    const auto add = [&options](const char* name, std::string text) {
        if (options.contains(name))
            throw triad::Error(Exit::usage,
                               "--" + std::string(name) + " is given among the options and beside them.");
        options.emplace(name, std::move(text));
    };
    if (settings.width > 0)
        add("size", std::to_string(settings.width) + "x" + std::to_string(settings.height));
    if (settings.spp) add("spp", std::to_string(*settings.spp));
    if (settings.seed != 0) add("seed", std::to_string(settings.seed));
    if (!settings.device.empty()) add("device", settings.device);
    return options;
}

std::optional<double> where_known(double value) { return value < 0 ? std::nullopt : std::optional(value); }

Progress shown(const triad::Progress& p) {
    return {.done = p.done,
            .seconds = p.seconds,
            .seconds_left = where_known(p.seconds_left),
            .spp = p.samples,
            .relmse = where_known(p.relmse)};
}

/// Renders as the request says. `report` throws nothing.
Film film_of(RenderRequest request, const LoadedScene& loaded,
             const std::function<bool(const triad::Progress&)>& report) {
    request.in_memory = true;
    const RenderRequest asked = request;
    OpenDevices devices = take_devices(asked);
    RenderSession session(std::move(request), loaded, &devices);
    RenderOutcome outcome = session.render(report);
    if (!session.request().film_path.empty()) session.write(outcome);
    Film::Inside inside;
    inside.facts = session.facts_of(outcome);
    for (Channel& layer : session.layers_of(outcome)) inside.layers[layer.name] = std::move(layer.values);
    inside.style = session.request().style, inside.is_chosen = true;
    inside.reconstruct = session.request().reconstruct;
    inside.complete = outcome.complete();
    inside.device = session.renderer().device();
    inside.film = std::move(outcome.film);
    const auto& worked = outcome.result.devices;
    if (std::all_of(worked.begin(), worked.end(), [](const DeviceWork& d) { return d.failure.empty(); }))
        keep_devices(asked, std::move(devices));
    return Film(std::make_shared<const Film::Inside>(std::move(inside)));
}

}  // namespace

Film render(const Scene& scene, const Settings& settings, const Report& report) {
    Callback callback;
    const auto call = [&](const triad::Progress& p) {
        return callback([&] { return !report || report(shown(p)); });
    };
    const Film film = guarded([&] {
        RenderRequest request = scene.inside().request;
        parse_render_options(options_of(settings), request);
        return film_of(std::move(request), scene.inside().loaded, call);
    });
    callback.rethrow();
    return film;
}

Film render(const std::filesystem::path& path, const Settings& settings, const Report& report) {
    Settings rest = settings;
    const Options of_load = take_load_options(rest.options);
    return render(load(path, of_load), rest, report);
}

}  // namespace triad::api
