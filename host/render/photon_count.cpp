#include "render/photon_count.h"

#include <algorithm>
#include <cmath>

#include "kernels/types.h"
#include "scene/film.h"
#include "trace/device_scene.h"

namespace triad {
namespace {

/// What a photon costs in rays of paths: it looks at every caster, is traced, splatted and sorted into a map.
constexpr double rays_per_photon = 8;
/// With so few they cost next to nothing, and fewer would be brighter specks.
constexpr double least_photons = 1.0 / 64;
/// Of the pilot's second flight.
constexpr double few_photons = 1.0 / 16;
constexpr double pilot_pixels = 3072;
constexpr std::uint64_t pilot_samples = 16;
constexpr std::uint32_t pilot_seed = 0x70686f74;  // none that pictures have by counting

struct Pilot {
    double relmse, rays;  ///< rays of paths and photons
};

Pilot fly(Renderer& renderer, double photon_share) {
    renderer.restart(pilot_seed);
    renderer.render_until(
        RenderGoal{.samples = {0, pilot_samples}, .follow = false, .photon_share = photon_share},
        [](const Progress&) { return true; });
    const Film film = renderer.film();
    return {std::max(estimated_relmse(film), 0.0), double(film.counters[COUNTER_RAYS])};
}

}  // namespace

double best_photon_share(double paths, double photons, double rays_per_pixel) {
    // (paths + photons / s) (rays_per_pixel + rays_per_photon s) is least at
    const double best = std::sqrt(photons * rays_per_pixel / (paths * rays_per_photon));
    if (!(best > least_photons)) return least_photons;
    return std::exp2(std::round(std::log2(std::min(best, 1.0))));
}

RenderSettings with_photon_count(const DeviceScenes& scenes, const RenderSettings& settings) {
    RenderSettings result = settings;
    const PackedScene& packed = *scenes.front()->shared();
    if (settings.integrator != Integrator::automatic || packed.chosen != Integrator::photons ||
        settings.photons > 0)
        return result;
    const double all = double(settings.width) * settings.height;
    const double scale = std::min(1.0, std::sqrt(pilot_pixels / all));
    const auto smaller = [&](unsigned side) { return unsigned(std::max(1.0, std::round(scale * side))); };
    RenderSettings small = settings;
    small.width = smaller(settings.width), small.height = smaller(settings.height);
    small.crop = {};
    small.bins_x = small.bins_y = 1;
    const double pixels = double(small.width) * small.height;
    small.photons = std::uint64_t(pixels);
    Renderer renderer({scenes.front()}, small);
    // Both have the same paths, and so the same noise of these.
    const Pilot many = fly(renderer, 1), few = fly(renderer, few_photons);
    const double photons = std::max(0.0, (few.relmse - many.relmse) / (1 / few_photons - 1));
    const double paths = std::max(many.relmse - photons, 0.01 * many.relmse);
    const double photon_rays = (many.rays - few.rays) / (1 - few_photons);
    const double share =
        best_photon_share(paths, photons, (many.rays - photon_rays) / (pixels * pilot_samples));
    result.photons = std::uint64_t(std::ceil(share * double(usual_photons(settings))));
    return result;
}

}  // namespace triad
