/// The photons of a sample of the picture, on the device.
#include <algorithm>

#include "render/renderer_state.h"

namespace triad {

void Renderer::State::prepare_photons() {
    if (packed.casters.empty()) return;
    const dev::PhotonFrame shared = photon_frame_of(packed, settings, frame);
    photons = shared.count;
    photon_frame = device.upload(std::vector<dev::PhotonFrame>{shared});
    photon_lights = device.upload(packed.photon_lights);
    casters = device.upload(packed.casters);
    scene.bytes += photon_frame.bytes() + photon_lights.bytes() + casters.bytes();
    trace_photons = device.build("photon/photon.cl", options_of(features)).kernel("trace_photons");
    launch_photons(0, photons, 0);  // compiles, on some drivers; the film is still to be cleared
}

void Renderer::State::launch_photons(std::uint64_t sample, std::uint64_t count, std::uint32_t held) {
    constexpr std::size_t most = largest_launch * FILM_TILE_PIXELS;
    std::uint32_t first_pixel = 0;
    for (const Band& band : bands) {  // a film in several pieces is rare: photons are traced for each
        const std::uint32_t pixels = std::uint32_t(band.half_sums.bytes() / (3 * sizeof(std::int64_t)));
        for (std::uint64_t first = 0; first < count; first += most) {
            const std::size_t now = std::min<std::uint64_t>(count - first, most);
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
                           .add(samples)
                           .add(held)
                           .add(first_pixel)
                           .add(pixels),
                       now);
        }
        first_pixel += pixels;
    }
}

}  // namespace triad
