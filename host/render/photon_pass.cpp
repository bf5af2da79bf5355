/// The photons of a sample of the picture, on the device.
#include <algorithm>

#include "render/renderer_state.h"

namespace triad {
namespace {

/// nm: half the width in which light of one wavelength is gathered with the first sample. It shrinks as the
/// radius does.
constexpr double first_wavelengths = 10;
/// Watchdogs and PoCL (largest_launch) want short launches.
constexpr std::size_t most_items = largest_launch * FILM_TILE_PIXELS;
/// After an event that blurs, the radius is wider by this: what comes of it is not seen sharply.
constexpr double blurred_radius = 2.5;
/// The same in the classic map.
constexpr double classic_blurred_radius = 4;

}  // namespace

void Renderer::State::allocate_photons() {
    if (packed.chosen == Integrator::path) return;
    const dev::PhotonFrame shared = photon_frame_of(packed, settings, frame);
    photons = shared.count;
    photon_frame = device.upload(std::vector<dev::PhotonFrame>{shared});
    photon_lights = device.upload(packed.photon_lights);
    casters = device.upload(packed.casters);
    if (packed.chosen == Integrator::light) return;
    map = PhotonMap(device, photons);
}

void Renderer::State::prepare_photons() {
    if (photons == 0) return;
    photon_tiles = device.upload(std::vector<std::uint32_t>(tiles, 1));
    for (const Buffer* b : {&photon_frame, &photon_lights, &casters, &photon_tiles})
        scene.bytes += b->bytes();
    scene.bytes += map.bytes();
    const Options options = options_of(features);
    trace_photons = device.build("path/photons.cl", options).kernel("trace_photons");
    if (map) map.compile(options);
    // Compiles, on some drivers; the film is still to be cleared.
    launch_photons(0, std::min<std::uint64_t>(photons, 64));
    device.finish();
    photon_seconds = 0;
}

void Renderer::State::set_photon_tiles(const std::vector<std::uint32_t>& chosen) {
    device.write(photon_tiles, chosen.data(), chosen.size() * sizeof(std::uint32_t));
}

void Renderer::State::launch_photons(std::uint64_t sample, std::uint64_t count) {
    std::uint32_t first_pixel = 0;
    for (const Band& band : bands) {  // a film in several pieces is rare: photons are traced for each
        const std::uint32_t pixels = std::uint32_t(band.half_sums.bytes() / (3 * sizeof(std::int64_t)));
        for (std::uint64_t first = 0; first < count; first += most_items) {
            const std::size_t now = std::min<std::uint64_t>(count - first, most_items);
            device.run(trace_photons,
                       Arguments()
                           .add(scene.arguments)
                           .add(band.sums)
                           .add(band.half_sums)
                           .add(counters)
                           .add(photon_frame)
                           .add(photon_lights)
                           .add(casters)
                           .add(std::uint32_t(sample))
                           .add(std::uint32_t(sample >> 32))
                           .add(std::uint32_t(first))
                           .add(std::uint32_t(now))
                           .add(1.0f / float(count))
                           .add(map.landed())
                           .add(photon_tiles)
                           .add(first_pixel)
                           .add(pixels),
                       now);
        }
        if (is_classic()) break;  // nothing of it goes to the film
        first_pixel += pixels;
    }
    if (!map) return;
    const double radius = photon_radius(packed, settings, frame, sample);
    dev::PhotonMap shape{};
    shape.radius = float(radius * (is_classic() ? classic_blurred_radius : blurred_radius));
    shape.sharp_radius = float(radius);
    shape.wavelengths = float(first_wavelengths * radius / photon_radius(packed, settings, frame, 0));
    map.sort(shape, count);
}

}  // namespace triad
