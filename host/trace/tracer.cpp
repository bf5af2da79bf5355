#include "trace/tracer.h"

#include <algorithm>
#include <exception>
#include <string>

#include "pack/ray_filter.h"
#include "scene/film_sets.h"

namespace triad {

Tracer::Tracer(std::shared_ptr<const DeviceScene> scene, const RenderSettings& settings,
               const Features& features, const Film& shape)
    : scene_(std::move(scene)),
      device_(scene_->device()),
      settings_(settings),
      features_(features),
      frame_(frame_of(scene_->packed(), settings)),
      frame_buffer_(device_.upload(std::vector<dev::Frame>{frame_})),
      photons_(*scene_, settings, frame_, tile_count(shape.width, shape.height)),
      arguments_(scene_->arguments(frame_buffer_, device_.upload(ray_filter_tables(settings)),
                                   photons_.map().buffers())),
      part_(device_, shape),
      work_(device_.allocate_array<dev::TileWork>(tile_count(shape.width, shape.height))) {
    driver_ = make_path_driver(*scene_, settings, features);
    part_.clear();
    photons_.compile(options_of(features), arguments_, part_);
    const dev::TileWork first_tile{0, {0, 0}, {1, 1}, {}};
    set_work({&first_tile, 1});
    trace(0, 1, 0);
    finish();
    part_.clear();
}

void Tracer::restart(std::uint32_t seed) {
    settings_.seed = frame_.seed = seed;
    device_.write(frame_buffer_, &frame_, sizeof frame_);
    part_.clear();
    photons_.restart();
}

void Tracer::empty() {
    part_.clear();
    finish();
}

std::string Tracer::why_lost() const {
    if (!failure) return {};
    try {
        std::rethrow_exception(failure);
    } catch (const std::exception& error) {
        return error.what();
    }
}

void Tracer::set_work(std::span<const dev::TileWork> work) {
    tiles_.assign(work.begin(), work.end());
    device_.write(work_, work.data(), work.size_bytes());
}

void Tracer::trace(std::size_t first, std::size_t count, std::uint64_t first_sample) {
    while (count > 0) {
        const FilmPart::Band& band = part_.band_of_tile(tiles_[first].tile);
        const auto inside = [&](const dev::TileWork& w) { return &part_.band_of_tile(w.tile) == &band; };
        const std::size_t n = std::size_t(
            std::find_if_not(tiles_.begin() + long(first), tiles_.begin() + long(first + count), inside) -
            (tiles_.begin() + long(first)));
        const dev::TracePathsArguments own{.sums = band.sums,
                                           .half_sums = band.half_sums,
                                           .samples = part_.samples(),
                                           .counters = part_.counters(),
                                           .work = work_,
                                           .first_work = std::uint32_t(first),
                                           .work_count = std::uint32_t(n),
                                           .first_sample_low = std::uint32_t(first_sample),
                                           .first_sample_high = std::uint32_t(first_sample >> 32),
                                           .first_pixel = std::uint32_t(band.first_pixel)};
        driver_->trace(arguments_, own);
        first += n, count -= n;
    }
}

void Tracer::finish() {
    driver_->finish();
    device_.finish();
}

MemoryUse Tracer::memory() const {
    MemoryUse use = scene_->memory();
    use.insert(use.end(), {{"film", part_.bytes()},
                           {"work", frame_buffer_.bytes() + work_.bytes()},
                           {"photon map", photons_.bytes()},
                           {"paths under way", driver_->bytes()}});
    std::erase_if(use, [](const auto& each) { return each.second == 0; });
    return use;
}

std::uint64_t Tracer::bytes() const {
    return scene_->bytes() + frame_buffer_.bytes() + photons_.bytes() + part_.bytes() + work_.bytes() +
           driver_->bytes();
}

}  // namespace triad
