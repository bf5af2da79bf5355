#include "render/film_store.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "kernels/types.h"

namespace triad {

FilmStore::FilmStore(const PackedScene& packed, const RenderSettings& settings) {
    const dev::Frame frame = frame_of(packed, settings);
    film_.full_width = settings.width, film_.full_height = settings.height;
    film_.x = frame.crop[0], film_.y = frame.crop[1];
    film_.width = frame.crop[2], film_.height = frame.crop[3];
    film_.bins_x = settings.bins_x, film_.bins_y = settings.bins_y;
    film_.quanta_log2 = packed.quanta_log2;
    film_.scene = packed.scene;
    restart(packed, settings);
}

void FilmStore::restart(const PackedScene& packed, const RenderSettings& settings) {
    film_.settings_text = text_of(settings, packed);
    film_.settings = Hash().add(film_.settings_text).hex();
    film_.ranges.clear();
    film_.progress.reset();
    film_.shares.clear();
    film_.sums.clear(), film_.half_sums.clear(), film_.samples.clear();
    film_.counters = {};
}

void FilmStore::add_device(const std::string& words) {
    const auto place = std::lower_bound(film_.devices.begin(), film_.devices.end(), words);
    if (place == film_.devices.end() || *place != words) film_.devices.insert(place, words);
}

std::uint32_t FilmStore::place_of(const DeviceInfo& device) const {
    return std::uint32_t(std::lower_bound(film_.devices.begin(), film_.devices.end(), words_of(device)) -
                         film_.devices.begin());
}

const Film& FilmStore::gather(const Tracers& tracers) {
    film_.sums.clear(), film_.half_sums.clear(), film_.samples.clear();
    film_.counters = {};
    for (const auto& tracer : tracers) tracer->part().add_to(film_);
    return film_;
}

namespace {

/// Of the samples of a device: a scene may bring some, but a device that computes so many computes nothing
/// right.
constexpr double most_not_finite = 0.1;

/// Throws where a part is not what was asked for, or is no picture.
void require_sane(const Film& part, const SetSamples& expected, const DeviceInfo& device) {
    const auto refuse = [&](const std::string& what) {
        throw Error(Exit::device, "The device " + device.name + " " + what + ".");
    };
    const std::size_t across = (part.width + FILM_TILE - 1) / FILM_TILE;
    std::uint64_t samples = 0;
    for (std::size_t y = 0; y < part.height; ++y)
        for (std::size_t x = 0; x < part.width; ++x) {
            const std::uint32_t n = part.samples[y * part.width + x];
            if (n != expected[2 * (y / FILM_TILE * across + x / FILM_TILE) + ((x ^ y) & 1)])
                refuse("did not take the samples that it was to take");
            samples += n;
        }
    if (double(part.counters[COUNTER_NOT_FINITE]) > most_not_finite * double(samples))
        refuse("computed samples that are no numbers: " + std::to_string(part.counters[COUNTER_NOT_FINITE]) +
               " of " + std::to_string(samples));
}

}  // namespace

void FilmStore::deliver(Tracer& tracer, const SetSamples& expected) {
    Film part;
    part.width = film_.width, part.height = film_.height;
    part.bins_x = film_.bins_x, part.bins_y = film_.bins_y;
    tracer.part().add_to(part);
    require_sane(part, expected, tracer.device().info());
    if (film_.sums.empty()) {
        film_.sums = std::move(part.sums), film_.half_sums = std::move(part.half_sums);
        film_.samples = std::move(part.samples);
    } else {
        add_sums(film_.sums, part.sums);
        add_sums(film_.half_sums, part.half_sums);
        for (std::size_t i = 0; i < film_.samples.size(); ++i) film_.samples[i] += part.samples[i];
    }
    for (std::size_t c = 0; c < film_.counters.size(); ++c) film_.counters[c] += part.counters[c];
}

void FilmStore::begin_with(const Film& film) {
    film_.sums = film.sums, film_.half_sums = film.half_sums, film_.samples = film.samples;
    film_.counters = film.counters;
}

Film FilmStore::take() {
    Film taken = merged_header(std::span<const Film>(&film_, 1));
    taken.sums = std::exchange(film_.sums, {}), taken.half_sums = std::exchange(film_.half_sums, {});
    taken.samples = std::exchange(film_.samples, {});
    return taken;
}

void FilmStore::drop_tiles(const std::vector<bool>& tiles) {
    const std::size_t across = (film_.width + FILM_TILE - 1) / FILM_TILE, bins = film_.bins() * 4;
    for (std::size_t p = 0; p < film_.pixels(); ++p) {
        if (!tiles[p / film_.width / FILM_TILE * across + p % film_.width / FILM_TILE]) continue;
        std::fill_n(film_.sums.begin() + std::ptrdiff_t(p * bins), bins, 0);
        std::fill_n(film_.half_sums.begin() + std::ptrdiff_t(p * 3), 3, 0);
        film_.samples[p] = 0;
    }
}

}  // namespace triad
