/// Film files (docs/film.md): a prefix, a header, a block for every row of tiles, and one for the progress of
/// a film that is not complete. Each is followed by its checksum, so that damage costs the rows that it hit.
#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "io/film_header.h"
#include "io/io.h"
#include "kernels/types.h"

namespace triad {
namespace {

static_assert(std::endian::native == std::endian::little, "film files are written as they lie in memory");

constexpr char magic[12] = {'T', 'R', 'I', 'A', 'D', 'F', 'I', 'L', 'M', 0, 0, 0};
constexpr std::uint32_t version = 2;
constexpr std::size_t prefix_size = sizeof magic + sizeof(std::uint32_t) + sizeof(std::uint64_t),
                      checksum_size = 32;
constexpr std::uint64_t most_header = 64 << 20;
/// A file that lacks more than this share of itself is no film to be saved.
constexpr std::uint64_t least_share = 16;

/// Arrays that lie one after the other in a file.
struct Piece {
    void* data;
    std::size_t bytes;
};
using Block = std::vector<Piece>;

std::size_t bytes_of(const Block& block) {
    std::size_t bytes = checksum_size;
    for (const Piece& piece : block) bytes += piece.bytes;
    return bytes;
}

/// The place of a block is part of its checksum, so that blocks cannot change places.
std::string checksum(std::uint64_t place, const Block& block) {
    Hash hash;
    hash.add_value(place);
    for (const Piece& piece : block) hash.add(piece.data, piece.bytes);
    return hash.hex();
}

std::size_t block_rows(const Film& film) { return (film.height + FILM_TILE - 1) / FILM_TILE; }

/// Rows [FILM_TILE i, FILM_TILE (i + 1)) of the crop.
Block rows_of(Film& film, std::size_t i) {
    const std::size_t first = i * FILM_TILE * film.width,
                      pixels = std::min<std::size_t>((i + 1) * FILM_TILE, film.height) * film.width - first,
                      sums = film.bins() * 4;
    return {{&film.sums[first * sums], pixels * sums * sizeof(std::int64_t)},
            {&film.half_sums[first * 3], pixels * 3 * sizeof(std::int64_t)},
            {&film.samples[first], pixels * sizeof(std::uint32_t)}};
}

Block block_of(FilmProgress& progress) {
    return {{progress.wanted.data(), progress.wanted.size() * sizeof(std::uint32_t)},
            {progress.set_errors.data(), progress.set_errors.size()}};
}

class FilmReader {
  public:
    explicit FilmReader(const std::filesystem::path& path) : path_(path), file_(path) { read_header(); }

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(Exit::scene, "Film " + path_.string() + " cannot be used: " + why + ".");
    }

    /// Without its arrays.
    const Film& film() const { return film_; }

    /// The arrays, as far as they are whole. Rows that are not are listed, and are zero.
    SalvagedFilm read() {
        const std::uint64_t pixels = film_.pixels(), sums = pixels * film_.bins() * 4;
        // At most 2^40 pixels of 2^12 bins: 64 bits hold every product.
        const std::uint64_t needed = sums * 8 + pixels * (3 * 8 + 4), have = file_.size() - header_end_;
        if (have < needed / least_share)
            refuse("it has " + std::to_string(have) + " bytes of sums, and its size asks for " +
                   std::to_string(needed));
        if (sizes_.wanted > file_.size() / 4 || sizes_.set_errors > file_.size())
            refuse("what it keeps of its progress is larger than it is");
        film_.sums.resize(sums), film_.half_sums.resize(pixels * 3), film_.samples.resize(pixels);
        SalvagedFilm found;
        for (std::size_t i = 0; i < block_rows(film_); ++i) {
            const Block rows = rows_of(film_, i);
            if (read(i, rows)) continue;
            for (const Piece& piece : rows) std::memset(piece.data, 0, piece.bytes);
            found.lost.push_back({unsigned(i * FILM_TILE),
                                  unsigned(std::min<std::size_t>((i + 1) * FILM_TILE, film_.height))});
        }
        if (film_.progress) {
            film_.progress->wanted.resize(sizes_.wanted),
                film_.progress->set_errors.resize(sizes_.set_errors);
            if (!read(block_rows(film_), block_of(*film_.progress))) {
                found.lost_progress = true;
                film_.progress->wanted.clear(), film_.progress->set_errors.clear();
                film_.progress->estimates.clear();
            }
        }
        found.has_more = file_.size() > at_;
        found.film = std::move(film_);
        return found;
    }

  private:
    std::filesystem::path path_;
    InputFile file_;
    Film film_;
    ProgressSizes sizes_;
    std::uint64_t at_ = 0, header_end_ = 0;

    bool read(void* to, std::size_t bytes) {
        if (bytes > file_.size() - at_) return false;
        file_.read(to, bytes);
        at_ += bytes;
        return true;
    }

    /// False when the file ends early or the checksum does not match.
    bool read(std::uint64_t place, const Block& block) {
        if (bytes_of(block) > file_.size() - at_) {
            at_ = file_.size();
            return false;
        }
        for (const Piece& piece : block) read(piece.data, piece.bytes);
        char sum[checksum_size];
        read(sum, sizeof sum);
        return checksum(place, block) == std::string_view(sum, sizeof sum);
    }

    void read_header() {
        char found_magic[sizeof magic];
        std::uint32_t found_version;
        std::uint64_t length;
        if (!read(found_magic, sizeof found_magic) || std::memcmp(found_magic, magic, sizeof magic) != 0)
            refuse("it is no film file");
        if (!read(&found_version, sizeof found_version)) refuse("it ends early");
        if (found_version != version)
            refuse("its version is " + std::to_string(found_version) + " and this Triad reads version " +
                   std::to_string(version) + "; render it again");
        if (!read(&length, sizeof length) || length > file_.size() || length > most_header)
            refuse("it ends early");
        std::string header(length, 0);
        char sum[checksum_size];
        if (!read(header.data(), length) || !read(sum, sizeof sum)) refuse("it ends early");
        if (Hash().add(header).hex() != std::string_view(sum, sizeof sum))
            refuse(
                "the checksum of its header does not match, and without a header nothing of it can be saved");
        film_ = film_of_header(header, sizes_, [this](const std::string& why) { refuse(why); });
        header_end_ = at_;
    }
};

}  // namespace

bool is_film(const std::filesystem::path& path) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed)) return false;
    InputFile file(path);
    char start[sizeof magic];
    if (file.size() < sizeof start) return false;
    file.read(start, sizeof start);
    return std::memcmp(start, magic, sizeof magic) == 0;
}

void save_film(const std::filesystem::path& path, const Film& film) {
    const std::string header = film_header(film);
    const std::uint64_t length = header.size();
    // Blocks point into what they read or write; here nothing is changed.
    Film& readable = const_cast<Film&>(film);
    write_file(path, [&](const ByteSink& write) {
        write({magic, sizeof magic});
        write({reinterpret_cast<const char*>(&version), sizeof version});
        write({reinterpret_cast<const char*>(&length), sizeof length});
        write(header);
        write(Hash().add(header).hex());
        const auto add = [&](std::uint64_t place, const Block& block) {
            for (const Piece& piece : block) write({static_cast<const char*>(piece.data), piece.bytes});
            write(checksum(place, block));
        };
        for (std::size_t i = 0; i < block_rows(film); ++i) add(i, rows_of(readable, i));
        if (film.progress) add(block_rows(film), block_of(*readable.progress));
    });
}

Film load_film_header(const std::filesystem::path& path) { return FilmReader(path).film(); }

SalvagedFilm salvage_film(const std::filesystem::path& path) {
    FilmReader reader(path);
    SalvagedFilm found = reader.read();
    Film& film = found.film;
    if (found.has_more) reader.refuse("bytes follow its end");
    if (!found.lost.empty()) {
        if (film.ranges.size() > 1)
            reader.refuse(found.damage() +
                          ", and it holds several ranges of samples, which cannot be mended");
        if (!film.progress) {
            if (film.ranges.empty()) reader.refuse(found.damage());
            film.progress = FilmProgress{.words = {}, .samples = film.ranges[0]};
        }
        film.progress->ended = false;
        film.ranges.clear();
    }
    const std::uint64_t least = film.sample_count();
    for (const std::uint32_t n : film.samples)
        if (n < least) reader.refuse("some pixel holds fewer samples than its ranges say");
    return found;
}

Film load_film(const std::filesystem::path& path) {
    SalvagedFilm found = salvage_film(path);
    if (!found.damage().empty())
        throw Error(Exit::scene, "Film " + path.string() + " cannot be used: " + found.damage() +
                                     ". triad render --resume " + path.string() +
                                     " keeps the rest and renders what is missing again.");
    return std::move(found.film);
}

std::string SalvagedFilm::damage() const {
    std::string text;
    for (const auto& [begin, end] : lost)
        text += (text.empty() ? "rows " : ", ") + std::to_string(begin) + " to " + std::to_string(end - 1);
    if (!text.empty()) return text + " of its crop are damaged or missing";
    return lost_progress ? "what it keeps of its progress is damaged or missing" : "";
}

}  // namespace triad
