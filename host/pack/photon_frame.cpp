/// What all photons of a picture share, and how far around a point they are gathered.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "pack/pack.h"

namespace triad {
namespace {

/// The first radius of gathering: in pixels, as the nearest caster is seen, and such that so many photons
/// would lie in it if all were spread over the casters' discs, but no more than this share of the scene.
constexpr double first_pixels = 2, first_photons = 32, most_radius = 0.05;
/// Photons with a sample of a large picture, if nobody asks for more: half a gigabyte in the map.
constexpr std::uint64_t most_usual = 1 << 24;
/// Share of the photons of a sample by which later radii keep theirs (alpha of Knaus and Zwicker 2011).
constexpr double shrinking = 2.0 / 3.0;
/// Of the extent of the scene: below it, single precision cannot tell places apart.
constexpr double least_radius = 1e-5;
/// Photons in the sharp radius of the classic map, if they were spread over the walls of a box around the
/// scene.
constexpr double mapped_photons = 6;

}  // namespace

double photon_radius(const PackedScene& packed, const RenderSettings& settings, const dev::Frame& frame,
                     std::uint64_t sample) {
    const dev::PhotonFrame shared = photon_frame_of(packed, settings, frame);
    const double extent = packed.bounds.radius();
    double first = settings.photon_radius;
    if (integrator_of(packed, settings) == Integrator::photon_map) {
        const dvec3 size = packed.bounds.size();
        const double area = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
        if (first == 0) first = std::sqrt(mapped_photons * area / (pi * shared.count));
        return std::clamp(first, least_radius * extent, extent);
    }
    if (first == 0) {
        const dvec3 eye(frame.camera.origin[0], frame.camera.origin[1], frame.camera.origin[2]);
        double distance = INFINITY, discs = 0;
        for (const dev::Caster& c : packed.casters) {
            distance = std::min(distance, glm::length(dvec3(c.centre[0], c.centre[1], c.centre[2]) - eye));
            discs += double(c.radius) * c.radius;
        }
        if (frame.camera.projection == CAMERA_ORTHOGRAPHIC) distance = 1;
        first = std::max(first_pixels * distance * std::sqrt(double(shared.pixel_area)),
                         std::min(std::sqrt(first_photons * discs / shared.count), most_radius * extent));
    }
    // r_{i + 1}^2 = r_i^2 (i + alpha) / (i + 1) from i = 1 on (Knaus and Zwicker 2011, equation 15)
    const double i = double(sample) + 1;
    const double shrunk =
        std::exp(0.5 * (std::lgamma(i + shrinking) - std::lgamma(1 + shrinking) - std::lgamma(i + 1)));
    return std::clamp(first * shrunk, least_radius * extent, extent);
}

Integrator integrator_of(const PackedScene& packed, const RenderSettings& settings) {
    return settings.integrator == Integrator::path ? Integrator::path : packed.chosen;
}

std::uint64_t usual_photons(const RenderSettings& settings) {
    return std::min(most_usual, std::uint64_t(settings.width) * settings.height);
}

dev::PhotonFrame photon_frame_of(const PackedScene& packed, const RenderSettings& settings,
                                 const dev::Frame& frame) {
    const bool map = integrator_of(packed, settings) == Integrator::photon_map;
    const std::uint64_t usual = map ? 1000000 : usual_photons(settings);
    const std::uint64_t count = settings.photons ? settings.photons : usual;
    if (count > 0xffffffffull)
        throw Error(Exit::usage, "--photons " + std::to_string(count) +
                                     ": a sample of the picture takes at most 2^32 - 1 photons; ask for more "
                                     "samples instead.");
    dev::PhotonFrame f{};
    f.count = std::uint32_t(count);
    f.casters = map || !settings.aim_photons ? 0 : std::uint32_t(packed.casters.size());
    f.scatter = map;
    f.pixel_area = frame.camera.pixel_area;
    f.lights = packed.photon_lights_shape;
    const dvec3 centre = packed.bounds.centre();
    for (int i = 0; i < 3; ++i) f.scene_centre[i] = float(centre[i]);
    f.scene_radius = float(packed.bounds.radius());
    return f;
}

}  // namespace triad
