#include "bench/error_reference.h"

#include <algorithm>

#include "base/hash.h"
#include "base/log.h"

namespace triad {
namespace {

/// Not among the seeds of runs, which count up from --seed.
constexpr std::uint32_t reference_seed = 0xfffffff0;

bool extends(const Film& kept, const Film& film) {
    return kept.scene == film.scene && kept.settings == film.settings &&
           kept.settings_text == film.settings_text && kept.quanta_log2 == film.quanta_log2 &&
           kept.width == film.width && kept.height == film.height && kept.is_even() &&
           kept.ranges.size() == 1 && kept.ranges[0].begin == 0;
}

}  // namespace

RenderSettings reference_settings(const RenderSettings& settings) {
    RenderSettings r;
    r.width = settings.width, r.height = settings.height, r.crop = settings.crop;
    r.max_depth = settings.max_depth;
    r.transparent = settings.transparent;
    r.spectral = settings.spectral;
    r.view = settings.view;
    r.environment_rotation = settings.environment_rotation;
    r.environment_strength = settings.environment_strength;
    r.seed = reference_seed;
    return r;
}

std::string reference_key(const Scene& scene, const RenderSettings& settings) {
    return Hash()
        .add("triad.reference/1")
        .add(hash_of(scene))
        .add(text_of(settings))
        .add(kernel_source::hash())
        .hex();
}

std::optional<RenderedReference> render_reference(const Scene& scene, const ErrorCase& like,
                                                  std::uint64_t spp, const ErrorBenchHost& host) {
    const RenderSettings settings = reference_settings(like.settings);
    const std::string key = reference_key(scene, settings);
    spp = std::max<std::uint64_t>(2, spp + spp % 2);  // two equal halves
    std::optional<Film> film = host.load_reference(key);
    const std::uint64_t have = film ? film->sample_count() : 0;
    double seconds = 0;
    if (have < spp) {
        Renderer renderer(*like.device, scene, settings);
        const bool usable = film && extends(*film, renderer.film());
        inform("Rendering the reference, " + std::to_string(spp) + " samples per pixel" +
               (usable ? " from " + std::to_string(have) + " on:" : ":"));
        const RenderResult result = renderer.render_until(
            {.samples = {usable ? have : 0, spp}},
            [&](const Progress& p) { return host.on_reference(p, double(usable ? have : 0)); });
        seconds = result.seconds;
        const Film more = renderer.film();
        film = usable ? merge(std::vector<Film>{std::move(*film), more}) : more;
        if (film->sample_count() > 0) host.keep_reference(key, *film);
        if (film->sample_count() < spp) return {};
    } else {
        inform("The reference is there from before, " + std::to_string(have) + " samples per pixel.");
    }
    RenderedReference reference{make_reference(*film), like.display(*like.device, *film), {}, seconds};
    reference.tiles.add(*film);
    return reference;
}

}  // namespace triad
