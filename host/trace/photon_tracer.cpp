#include "trace/photon_tracer.h"

#include <algorithm>

namespace triad {
namespace {

/// nm: half the width in which light of one wavelength is gathered with the first sample. It shrinks as the
/// radius does.
constexpr double first_wavelengths = 10;
/// After an event that blurs, the radius is wider by this: what comes of it is not seen sharply.
constexpr double blurred_radius = 2.5;
/// The same in the classic map.
constexpr double classic_blurred_radius = 4;

}  // namespace

PhotonTracer::PhotonTracer(const DeviceScene& scene, const RenderSettings& settings, const dev::Frame& frame,
                           std::size_t tiles)
    : scene_(scene), device_(scene.device()), settings_(settings), frame_(frame) {
    const PackedScene& packed = scene.packed();
    if (integrator() == Integrator::path) return;
    const dev::PhotonFrame shared = photon_frame_of(packed, settings, frame);
    count_ = shared.count;
    shared_ = device_.upload(std::vector<dev::PhotonFrame>{shared});
    lights_ = device_.upload(packed.photon_lights);
    casters_ = device_.upload(packed.casters);
    tiles_ = device_.upload(std::vector<std::uint32_t>(tiles, 1));
    if (integrator() != Integrator::light) map_ = PhotonMap(device_, count_);
}

void PhotonTracer::compile(const Options& options, const Arguments& arguments, const FilmPart& part) {
    if (count_ == 0) return;
    arguments_ = arguments;
    trace_photons_ = device_.build("path/photons.cl", options).kernel("trace_photons");
    if (map_) map_.compile(options);
    trace(0, std::min<std::uint64_t>(count_, 64), part);
    device_.finish();
}

void PhotonTracer::set_tiles(const std::vector<std::uint32_t>& chosen) {
    device_.write(tiles_, chosen.data(), chosen.size() * sizeof(std::uint32_t));
}

void PhotonTracer::trace(std::uint64_t sample, std::uint64_t count, const FilmPart& part) {
    for (const FilmPart::Band& band : part.bands()) {  // several are rare: photons are traced for each
        for (std::uint64_t first = 0; first < count; first += largest_launch_items) {
            const std::size_t now = std::min<std::uint64_t>(count - first, largest_launch_items);
            const dev::TracePhotonsArguments own{.sums = DeviceArray<std::uint32_t>(band.sums),
                                                 .half_sums = DeviceArray<std::uint32_t>(band.half_sums),
                                                 .counters = part.counters(),
                                                 .photon_frame = shared_,
                                                 .photon_lights = lights_,
                                                 .casters = casters_,
                                                 .sample_low = std::uint32_t(sample),
                                                 .sample_high = std::uint32_t(sample >> 32),
                                                 .first_photon = std::uint32_t(first),
                                                 .photon_count = std::uint32_t(now),
                                                 .share = 1.0f / float(count),
                                                 .landed = map_.landed(),
                                                 .tiles = tiles_,
                                                 .first_pixel = std::uint32_t(band.first_pixel),
                                                 .pixels = std::uint32_t(band.pixels)};
            device_.run(trace_photons_, Arguments(arguments_).add(arguments_of(own)), now);
        }
        if (is_classic()) break;  // nothing of it goes to the film
    }
    if (!map_) return;
    const PackedScene& packed = scene_.packed();
    const double radius = photon_radius(packed, settings_, frame_, sample);
    dev::PhotonMap shape{};
    shape.radius = float(radius * (is_classic() ? classic_blurred_radius : blurred_radius));
    shape.sharp_radius = float(radius);
    shape.wavelengths = float(first_wavelengths * radius / photon_radius(packed, settings_, frame_, 0));
    map_.sort(shape, count);
}

void PhotonTracer::make_classic_map(const FilmPart& part) {
    if (has_classic_map_) return;
    trace(0, count_, part);
    device_.finish();
    device_.fill_zero(part.counters());  // every part of a render makes it anew
    has_classic_map_ = true;
}

std::uint64_t PhotonTracer::bytes() const {
    return shared_.bytes() + lights_.bytes() + casters_.bytes() + tiles_.bytes() + map_.bytes();
}

}  // namespace triad
