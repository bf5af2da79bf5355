#include "render/film_store.h"

#include <algorithm>

#include "base/hash.h"

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

}  // namespace triad
