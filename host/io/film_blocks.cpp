#include "io/film_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "kernels/types.h"

namespace triad {
namespace {

static_assert(std::endian::native == std::endian::little, "film files are written as they lie in memory");

constexpr std::uint32_t version = 2;
constexpr std::size_t prefix_size = sizeof film_magic + sizeof(std::uint32_t) + sizeof(std::uint64_t),
                      checksum_size = 32;
constexpr std::uint64_t most_header = 64 << 20;
/// A file that lacks more than this share of itself is no film to be saved.
constexpr std::uint64_t least_share = 16;

std::size_t bytes_of(const FilmBlock& block) {
    std::size_t bytes = checksum_size;
    for (const FilmPiece& piece : block) bytes += piece.bytes;
    return bytes;
}

/// The place of a block is part of its checksum, so that blocks cannot change places.
std::string checksum(std::uint64_t place, const FilmBlock& block) {
    Hash hash;
    hash.add_value(place);
    for (const FilmPiece& piece : block) hash.add(piece.data, piece.bytes);
    return hash.hex();
}

std::size_t pixels_of(const Film& film, std::size_t i) {
    return std::min<std::size_t>((i + 1) * FILM_TILE, film.height) * film.width - i * FILM_TILE * film.width;
}

/// In a file.
std::uint64_t pixel_bytes(const Film& film) {
    return film.bins() * 4 * 8 + 3 * 8 + 4 + (film.has_guides ? DENOISE_GUIDES * 4 : 0);
}

/// Of block i from the first one on.
std::uint64_t offset_of(const Film& film, std::size_t i) {
    const std::uint64_t row = film.width * pixel_bytes(film);
    return std::min<std::uint64_t>(i * FILM_TILE, film.height) * row + i * checksum_size;
}

}  // namespace

std::size_t block_count(const Film& film) { return (film.height + FILM_TILE - 1) / FILM_TILE; }

FilmBlock rows_of(Film& film, std::size_t i) {
    const std::size_t first = i * FILM_TILE * film.width, pixels = pixels_of(film, i), sums = film.bins() * 4;
    FilmBlock block = {{&film.sums[first * sums], pixels * sums * sizeof(std::int64_t)},
                       {&film.half_sums[first * 3], pixels * 3 * sizeof(std::int64_t)},
                       {&film.samples[first], pixels * sizeof(std::uint32_t)}};
    if (film.has_guides)
        block.push_back({&film.guides[first * DENOISE_GUIDES], pixels * DENOISE_GUIDES * sizeof(float)});
    return block;
}

FilmBlock block_of(FilmProgress& progress) {
    return {{progress.wanted.data(), progress.wanted.size() * sizeof(std::uint32_t)},
            {progress.set_errors.data(), progress.set_errors.size()}};
}

void write_header(const ByteSink& write, const Film& film) {
    const std::string header = film_header(film);
    const std::uint64_t length = header.size();
    write({film_magic, sizeof film_magic});
    write({reinterpret_cast<const char*>(&version), sizeof version});
    write({reinterpret_cast<const char*>(&length), sizeof length});
    write(header);
    write(Hash().add(header).hex());
}

void write_block(const ByteSink& write, std::uint64_t place, const FilmBlock& block) {
    for (const FilmPiece& piece : block) write({static_cast<const char*>(piece.data), piece.bytes});
    write(checksum(place, block));
}

FilmReader::FilmReader(const std::filesystem::path& path) : path_(path) { read_header(); }

void FilmReader::refuse(const std::string& why) const {
    throw Error(Exit::scene, "Film " + path_.string() + " cannot be used: " + why + ".");
}

void FilmReader::read_header() {
    file_.emplace(path_);
    std::uint64_t left = file_->size();
    const auto take = [&](void* to, std::uint64_t bytes) {
        if (bytes > left) return false;
        file_->read(to, bytes);
        left -= bytes;
        return true;
    };
    char magic[sizeof film_magic];
    std::uint32_t found_version;
    std::uint64_t length;
    if (!take(magic, sizeof magic) || std::memcmp(magic, film_magic, sizeof magic) != 0)
        refuse("it is no film file");
    if (!take(&found_version, sizeof found_version)) refuse("it ends early");
    if (found_version != version)
        refuse("its version is " + std::to_string(found_version) + " and this Triad reads version " +
               std::to_string(version) + "; render it again");
    if (!take(&length, sizeof length) || length > left || length > most_header) refuse("it ends early");
    std::string header(length, 0);
    header_sum_.resize(checksum_size);
    if (!take(header.data(), length) || !take(header_sum_.data(), checksum_size)) refuse("it ends early");
    if (Hash().add(header).hex() != header_sum_)
        refuse("the checksum of its header does not match, and without a header nothing of it can be saved");
    film_ = film_of_header(header, sizes_, [this](const std::string& why) { refuse(why); });
    header_end_ = prefix_size + length + checksum_size;
}

InputFile& FilmReader::file() {
    if (file_) return *file_;
    file_.emplace(path_);
    std::string sum(checksum_size, 0);
    if (file_->size() >= header_end_) {
        file_->seek(header_end_ - checksum_size);
        file_->read(sum.data(), sum.size());
    }
    if (sum != header_sum_) refuse("it was changed while it was read");
    return *file_;
}

bool FilmReader::read(std::uint64_t i, const FilmBlock& block) {
    InputFile& file = this->file();
    const std::uint64_t at = header_end_ + offset_of(film_, i);
    if (at > file.size() || bytes_of(block) > file.size() - at) return false;
    file.seek(at);
    for (const FilmPiece& piece : block) file.read(piece.data, piece.bytes);
    char sum[checksum_size];
    file.read(sum, sizeof sum);
    return checksum(i, block) == std::string_view(sum, sizeof sum);
}

SalvagedFilm FilmReader::read() {
    const std::uint64_t size = file().size(), blocks = block_count(film_);
    const std::uint64_t pixels = film_.pixels(), sums = pixels * film_.bins() * 4;
    // At most 2^40 pixels of 2^12 bins: 64 bits hold every product.
    const std::uint64_t needed = pixels * pixel_bytes(film_), have = size - header_end_;
    if (have < needed / least_share)
        refuse("it has " + std::to_string(have) + " bytes of sums, and its size asks for " +
               std::to_string(needed));
    if (sizes_.wanted > size / 4 || sizes_.set_errors > size)
        refuse("what it keeps of its progress is larger than it is");
    SalvagedFilm found;
    Film& film = found.film = film_;
    film.sums.resize(sums), film.half_sums.resize(pixels * 3), film.samples.resize(pixels);
    if (film.has_guides) film.guides.resize(pixels * DENOISE_GUIDES);
    for (std::size_t i = 0; i < blocks; ++i) {
        const FilmBlock rows = rows_of(film, i);
        if (read(i, rows)) continue;
        for (const FilmPiece& piece : rows) std::memset(piece.data, 0, piece.bytes);
        found.lost.push_back(
            {unsigned(i * FILM_TILE), unsigned(std::min<std::size_t>((i + 1) * FILM_TILE, film.height))});
    }
    std::uint64_t end = header_end_ + offset_of(film, blocks);
    if (film.progress) {
        film.progress->wanted.resize(sizes_.wanted), film.progress->set_errors.resize(sizes_.set_errors);
        const FilmBlock progress = block_of(*film.progress);
        end += bytes_of(progress);
        if (!read(blocks, progress)) {
            found.lost_progress = true;
            film.progress->wanted.clear(), film.progress->set_errors.clear();
            film.progress->estimates.clear(), film.progress->rays = {};
        }
    }
    found.has_more = size > end;
    return found;
}

}  // namespace triad
