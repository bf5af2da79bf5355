#include "display/perceived_sets.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "kernels/types.h"
#include "panel/perceived.h"

namespace triad {
namespace {

/// Sets that have got less than this share of what they had tell nothing new.
constexpr double least_growth = 0.25;
/// Rows that are shown at once: copies of whole films would take much memory.
constexpr unsigned band_rows = 256;

/// Rows [begin, end) as one set alone has them: of every two pixels beside each other, that of the set.
Film rows_of(const Film& film, unsigned set, unsigned begin, unsigned end) {
    Film part;
    part.full_width = part.width = (film.width + 1) / 2, part.full_height = part.height = end - begin;
    part.bins_x = film.bins_x, part.bins_y = film.bins_y;
    part.quanta_log2 = film.quanta_log2, part.ranges = film.ranges;
    const std::size_t bins = film.bins() * 4;
    part.sums.reserve(part.pixels() * bins);
    part.half_sums.reserve(part.pixels() * 3);
    for (unsigned y = begin; y < end; ++y)
        for (unsigned pair = 0; pair < part.width; ++pair) {
            unsigned x = 2 * pair + ((set ^ y) & 1);
            if (x >= film.width) x -= std::min(x, 2u);  // the last one of an odd width: of the pair before
            const std::size_t p = std::size_t(y) * film.width + std::min(x, film.width - 1);
            const auto sums = film.sums.begin() + std::ptrdiff_t(p * bins);
            part.sums.insert(part.sums.end(), sums, sums + std::ptrdiff_t(bins));
            const auto halves = film.half_sums.begin() + std::ptrdiff_t(p * 3);
            part.half_sums.insert(part.half_sums.end(), halves, halves + 3);
            part.samples.push_back(film.samples[p]);
        }
    return part;
}

[[noreturn]] void refuse() {
    throw Error(Exit::scene, "The film cannot go on: what it keeps of the perceived error is damaged.");
}

/// How many, and their bytes.
template <class T>
void append(std::string& to, const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    to.append(reinterpret_cast<const char*>(&count), sizeof count);
    to.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class T>
std::vector<T> take(std::string_view& from) {
    std::uint64_t count = 0;
    if (from.size() < sizeof count) refuse();
    std::memcpy(&count, from.data(), sizeof count);
    from.remove_prefix(sizeof count);
    if (count > from.size() / sizeof(T)) refuse();
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), from.data(), count * sizeof(T));
    from.remove_prefix(count * sizeof(T));
    return values;
}

/// The mean over every tile.
std::vector<double> tile_means(const Film& film, const std::vector<float>& map) {
    const std::size_t across = (film.width + FILM_TILE - 1) / FILM_TILE;
    std::vector<double> sums(across * ((film.height + FILM_TILE - 1) / FILM_TILE)), pixels(sums.size());
    for (std::size_t y = 0; y < film.height; ++y)
        for (std::size_t x = 0; x < film.width; ++x) {
            const std::size_t tile = y / FILM_TILE * across + x / FILM_TILE;
            sums[tile] += map[y * film.width + x], pixels[tile] += 1;
        }
    for (std::size_t t = 0; t < sums.size(); ++t) sums[t] /= pixels[t];
    return sums;
}

}  // namespace

PerceivedSets::PerceivedSets(CurrentDevice device, const PanelView& panel, const DisplaySettings& display)
    : device_(std::move(device)), panel_(panel), display_(display) {
    display_.alpha = false;
    display_.taps.reset();
    display_.refine.reset();
}

SetErrors PerceivedSets::of(const Film& film, const SetSamples& have) {
    const std::vector<std::uint32_t> pixels = set_pixels(film.width, film.height);
    const std::size_t pairs = (film.width + 1) / 2;
    const bool first = had_.empty();
    // of go_on_from(): what was kept is of this film
    if (!first && (had_.size() != have.size() || before_[0].size() != pairs * film.height * 4)) refuse();
    std::array<std::vector<float>, 2> shown;  // all of it before anything is remembered: a device may fail
    for (unsigned set = 0; set < 2; ++set)
        for (unsigned y = 0; y < film.height; y += band_rows) {
            const std::vector<float> band = resolve_display(
                device_(), rows_of(film, set, y, std::min(y + band_rows, film.height)), display_);
            shown[set].insert(shown[set].end(), band.begin(), band.end());
        }
    errors_.resize(have.size());
    for (unsigned set = 0; set < 2; ++set) {
        const std::vector<float> now = std::exchange(before_[set], std::move(shown[set]));
        if (first) continue;
        RgbImage change{film.width, film.height, std::vector<float>(film.pixels() * 3)};
        for (std::size_t i = 0; i < change.rgb.size(); ++i) {
            const std::size_t p = i / 3, from = (p / film.width * pairs + p % film.width / 2) * 4 + i % 3;
            change.rgb[i] = before_[set][from] - now[from];
        }
        const std::vector<double> seen = tile_means(
            film, perceived_difference_map(panel_.panel, change, {.ppd = panel_.ppd, .border = 0}));
        for (std::size_t i = set; i < have.size(); i += 2)
            if (have[i] >= (1 + least_growth) * had_[i])
                errors_[i] = pixels[i] * seen[i / 2] / (1.0 / had_[i] - 1.0 / have[i]);
    }
    had_ = have;
    return first ? SetErrors{} : errors_;
}

std::string PerceivedSets::kept() const {
    std::string bytes;
    append(bytes, had_), append(bytes, errors_);
    for (const std::vector<float>& shown : before_) append(bytes, shown);
    return bytes;
}

void PerceivedSets::go_on_from(const std::string& kept) {
    std::string_view rest = kept;
    had_ = take<std::uint32_t>(rest), errors_ = take<double>(rest);
    for (std::vector<float>& shown : before_) shown = take<float>(rest);
    if (!rest.empty() || errors_.size() != had_.size() || before_[0].size() != before_[1].size()) refuse();
}

std::shared_ptr<SetErrorSource> perceived_sets(CurrentDevice device, const PanelView& panel,
                                               const DisplaySettings& display) {
    return std::make_shared<PerceivedSets>(std::move(device), panel, display);
}

}  // namespace triad
