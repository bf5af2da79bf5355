#include "render/photon_pilot.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "kernels/types.h"
#include "render/kept_pilot.h"
#include "scene/film.h"
#include "trace/device_scene.h"

namespace triad {
namespace {

/// What a photon costs in rays of paths: it looks at every caster, is traced, splatted and sorted into a map.
constexpr double rays_per_photon = 8;
/// What the launches for the photons of a sample cost in rays, however few they are.
constexpr double rays_per_flight = 10000;
/// With so few they cost next to nothing, and fewer would be brighter specks.
constexpr double least_photons = 1.0 / 64;
/// Of the pilot's second flight.
constexpr double few_photons = 1.0 / 16;
constexpr double pilot_pixels = 3072;
constexpr std::uint64_t pilot_samples = 16;
constexpr std::uint32_t pilot_seed = 0x70686f74;  // none that pictures have by counting
/// Paths alone must need this much less work: an error that they have not met is in no estimate.
constexpr double clear_gain = 1.1;
/// Side of the blocks of pixels whose means are compared, and how much larger than by their noise the mean
/// square of their differences may be: with 48 blocks, chance alone has three once in thousands of times.
constexpr std::size_t block = 8;
constexpr double most_difference = 3;

struct Pilot {
    Film film;
    double relmse, rays;  ///< rays of paths and photons
};

Pilot fly(Renderer& renderer, double photon_share) {
    renderer.restart(pilot_seed);
    renderer.render_until(
        RenderGoal{.samples = {0, pilot_samples}, .follow = false, .photon_share = photon_share},
        [](const Progress&) { return true; });
    Film film = renderer.film();
    const double relmse = std::max(estimated_relmse(film), 0.0), rays = double(film.counters[COUNTER_RAYS]);
    return {std::move(film), relmse, rays};
}

/// Sums over blocks, by channel, of means and of their noise: half the difference of their halves.
struct Blocks {
    std::vector<double> means, noise, pixels;

    explicit Blocks(const Film& film) : width_(film.width), across_((film.width + block - 1) / block) {
        const HalfMeans halves = *half_means(film);
        means.resize(across_ * ((film.height + block - 1) / block) * 3);
        noise.resize(means.size()), pixels.resize(means.size());
        for (std::size_t p = 0; p < film.pixels(); ++p)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t b = of(p, c);
                means[b] += (double(halves.first[3 * p + c]) + halves.second[3 * p + c]) / 2;
                noise[b] += (double(halves.first[3 * p + c]) - halves.second[3 * p + c]) / 2;
                pixels[b] += 1;
            }
    }
    /// Where that of a pixel's channel is.
    std::size_t of(std::size_t pixel, std::size_t channel) const {
        return (pixel / width_ / block * across_ + pixel % width_ / block) * 3 + channel;
    }

  private:
    std::size_t width_, across_;
};

/// The photons' part of the relMSE of `many`. Both have the same paths, and the few photons are the first of
/// the many: what differs is photons' noise. (The difference of their errors says as much in the mean, but
/// nothing of specks that one of a thousand photons makes.)
double photon_part(const Film& many, const Film& few) {
    const HalfMeans a = *half_means(many), b = *half_means(few);
    const Blocks blocks(many);
    double sum = 0;
    for (std::size_t i = 0; i < a.first.size(); ++i) {
        const double d = ((double(a.first[i]) - b.first[i]) - (double(a.second[i]) - b.second[i])) / 2;
        const std::size_t at = blocks.of(i / 3, i % 3);
        const double mean = blocks.means[at] / blocks.pixels[at];
        sum += d * d / (mean * mean + 0.01);
    }
    return sum / double(a.first.size()) / (1 / few_photons - 1);
}

RenderSettings small_picture(const RenderSettings& settings) {
    const double all = double(settings.width) * settings.height;
    const double scale = std::min(1.0, std::sqrt(pilot_pixels / all));
    const auto smaller = [&](unsigned side) { return unsigned(std::max(1.0, std::round(scale * side))); };
    RenderSettings small = settings;
    small.width = smaller(settings.width), small.height = smaller(settings.height);
    small.crop = {};
    small.bins_x = small.bins_y = 1;
    small.photons = std::uint64_t(small.width) * small.height;
    return small;
}

PilotChoice chosen(const std::shared_ptr<const DeviceScene>& scene, const RenderSettings& settings,
                   const RenderSettings& small) {
    const double pixels = double(small.width) * small.height;
    Renderer renderer({scene}, small);
    // Both have the same paths, and so the same noise of these.
    const Pilot many = fly(renderer, 1), few = fly(renderer, few_photons);
    const double photons = photon_part(many.film, few.film);
    const double paths = std::max(many.relmse - photons, 0.01 * many.relmse);
    const double photon_rays = (many.rays - few.rays) / (1 - few_photons);
    const double rays_per_pixel = (many.rays - photon_rays) / (pixels * pilot_samples);
    const double share = best_photon_share(paths, photons, rays_per_pixel);
    const PilotChoice with_photons{false, std::uint64_t(std::ceil(share * double(usual_photons(settings))))};
    if (!scene->packed().photons_in_doubt) return with_photons;

    RenderSettings alone = small;
    alone.integrator = Integrator::path;
    // With the same program, so that paths which are not chosen cost no compiling.
    Renderer paths_alone({scene}, alone, renderer.features());
    const Pilot path = fly(paths_alone, 1);
    const double flight = rays_per_flight / (double(settings.width) * settings.height);
    const double work = (paths + photons / share) * (rays_per_pixel + flight + rays_per_photon * share);
    const bool pays = clear_gain * path.relmse * path.rays / (pixels * pilot_samples) > work;
    return pays || !agree(path.film, many.film) ? with_photons : PilotChoice{true, 0};
}

}  // namespace

double best_photon_share(double paths, double photons, double rays_per_pixel) {
    // (paths + photons / s) (rays_per_pixel + rays_per_photon s) is least at
    const double best = std::sqrt(photons * rays_per_pixel / (paths * rays_per_photon));
    if (!(best > least_photons)) return least_photons;
    return std::exp2(std::round(std::log2(std::min(best, 1.0))));
}

bool agree(const Film& a, const Film& b) {
    const Blocks of_a(a), of_b(b);
    double difference = 0, noise = 0;
    for (std::size_t i = 0; i < of_a.means.size(); ++i) {
        const double mean = (of_a.means[i] + of_b.means[i]) / 2, d = of_a.means[i] - of_b.means[i];
        const double weight = 1 / (mean * mean + 0.01);
        difference += weight * d * d;
        noise += weight * (of_a.noise[i] * of_a.noise[i] + of_b.noise[i] * of_b.noise[i]);
    }
    return difference <= most_difference * noise;
}

RenderSettings with_photon_pilot(const DeviceScenes& scenes, const RenderSettings& settings) {
    const PackedScene& packed = *scenes.front()->shared();
    if (settings.integrator != Integrator::automatic ||
        integrator_of(packed, settings) != Integrator::photons || settings.photons > 0)
        return settings;
    const RenderSettings small = small_picture(settings);
    const DeviceInfo& device = scenes.front()->device().info();
    const std::string about = packed.scene + text_of(small, packed) + std::to_string(settings.width) + "x" +
                              std::to_string(settings.height);
    std::optional<PilotChoice> choice = kept_pilot(device, about);
    if (!choice) {
        for (std::size_t i = 0; !choice; ++i) {
            try {
                choice = chosen(scenes[i], settings, small);
                if (i == 0) keep_pilot(device, about, *choice);
            } catch (const DeviceError&) {  // another may do it; that this one cannot is told when it renders
                if (i + 1 == scenes.size()) throw;
            }
        }
    }
    RenderSettings result = settings;
    if (choice->paths) result.integrator = Integrator::path;
    result.photons = choice->photons;
    return result;
}

}  // namespace triad
