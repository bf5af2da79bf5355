#include "trace/film_part.h"

#include <algorithm>
#include <type_traits>

#include "kernels/types.h"

namespace triad {
namespace {

/// Adds what a device holds of `to`, which may be all of it: then nothing is added up.
template <class T>
void add(Device& device, const Buffer& from, T* to, bool is_zero) {
    if (is_zero) return device.read(from, to, from.bytes());
    const std::vector<T> values = device.download<T>(from);
    using Bits = std::make_unsigned_t<T>;  // modulo 2^n, as merge() adds
    std::transform(values.begin(), values.end(), to, to, [](T a, T b) { return T(Bits(a) + Bits(b)); });
}

}  // namespace

FilmPart::FilmPart(Device& device, const Film& shape) : device_(device), bins_(shape.bins()) {
    const std::size_t across = (shape.width + FILM_TILE - 1) / FILM_TILE,
                      rows = (shape.height + FILM_TILE - 1) / FILM_TILE,
                      pixel_bytes = bins_ * FILM_CHANNELS * sizeof(std::int64_t),
                      row_bytes = shape.width * FILM_TILE * pixel_bytes,
                      allowed = device.info().max_allocation;
    const std::size_t fit = allowed > 0 ? std::clamp<std::size_t>(allowed / row_bytes, 1, rows) : rows;
    for (std::size_t row = 0; row < rows; row += fit) {
        Band band;
        band.first_pixel = row * FILM_TILE * shape.width;
        band.pixels =
            shape.width * std::min<std::size_t>((row + fit) * FILM_TILE, shape.height) - band.first_pixel;
        band.end_tile = std::min(row + fit, rows) * across;
        band.sums = device.allocate_array<std::int64_t>(band.pixels * bins_ * FILM_CHANNELS);
        band.half_sums = device.allocate_array<std::int64_t>(band.pixels * 3);
        bands_.push_back(band);
    }
    samples_ = device.allocate_array<std::uint32_t>(shape.pixels());
    counters_ = device.allocate_array<std::uint32_t>(2 * COUNTERS);
}

void FilmPart::clear() {
    for (const Band& band : bands_) {
        device_.fill_zero(band.sums);
        device_.fill_zero(band.half_sums);
    }
    device_.fill_zero(samples_);
    device_.fill_zero(counters_);
}

void FilmPart::add_to(Film& film) const {
    const bool is_zero = film.sums.empty();
    film.sums.resize(film.pixels() * bins_ * FILM_CHANNELS);
    film.half_sums.resize(film.pixels() * 3);
    film.samples.resize(film.pixels());
    for (const Band& band : bands_) {
        add(device_, band.sums, &film.sums[band.first_pixel * bins_ * FILM_CHANNELS], is_zero);
        add(device_, band.half_sums, &film.half_sums[band.first_pixel * 3], is_zero);
    }
    add(device_, samples_, film.samples.data(), is_zero);
    const auto words = device_.download<std::uint32_t>(counters_);
    for (std::size_t i = 0; i < COUNTERS; ++i)
        film.counters[i] += words[2 * i] | std::uint64_t(words[2 * i + 1]) << 32;
}

void FilmPart::load(const Film& film) {
    for (const Band& band : bands_) {
        device_.write(band.sums, &film.sums[band.first_pixel * bins_ * FILM_CHANNELS], band.sums.bytes());
        device_.write(band.half_sums, &film.half_sums[band.first_pixel * 3], band.half_sums.bytes());
    }
    device_.write(samples_, film.samples.data(), samples_.bytes());
    std::uint32_t words[2 * COUNTERS];
    for (std::size_t i = 0; i < COUNTERS; ++i)
        words[2 * i] = std::uint32_t(film.counters[i]),
                  words[2 * i + 1] = std::uint32_t(film.counters[i] >> 32);
    device_.write(counters_, words, sizeof words);
}

const FilmPart::Band& FilmPart::band_of_tile(std::size_t tile) const {
    return *std::find_if(bands_.begin(), bands_.end(), [&](const Band& b) { return tile < b.end_tile; });
}

std::uint64_t FilmPart::bytes() const {
    std::uint64_t bytes = samples_.bytes() + counters_.bytes();
    for (const Band& band : bands_) bytes += band.sums.bytes() + band.half_sums.bytes();
    return bytes;
}

}  // namespace triad
