#pragma once
/// How a film lies in its file (docs/film.md): a prefix, a header, a block for every row of tiles, and one
/// for the progress of a film that is not complete. Each is followed by its checksum, so that damage costs
/// the rows that it hit.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/files.h"
#include "io/film_header.h"
#include "io/io.h"

namespace triad {

constexpr char film_magic[12] = {'T', 'R', 'I', 'A', 'D', 'F', 'I', 'L', 'M', 0, 0, 0};

/// Arrays that lie one after the other in a file.
struct FilmPiece {
    void* data;
    std::size_t bytes;
};
using FilmBlock = std::vector<FilmPiece>;

/// Rows of tiles.
std::size_t block_count(const Film& film);
/// Rows [FILM_TILE i, FILM_TILE (i + 1)) of the crop, in the film's arrays.
FilmBlock rows_of(Film& film, std::size_t i);
FilmBlock block_of(FilmProgress& progress);

void write_header(const ByteSink& write, const Film& film);
/// `place`: of the block in the file; a part of its checksum.
void write_block(const ByteSink& write, std::uint64_t place, const FilmBlock& block);

/// A film file. Its header is read at once, blocks when they are asked for.
class FilmReader {
  public:
    /// Throws Error(scene).
    explicit FilmReader(const std::filesystem::path& path);

    [[noreturn]] void refuse(const std::string& why) const;
    /// Without arrays.
    const Film& film() const { return film_; }

    /// All of it, as far as it is whole.
    SalvagedFilm read();
    /// Block i into `block`; false when the file ends early or the checksum does not match.
    bool read(std::uint64_t i, const FilmBlock& block);
    /// Frees the file's descriptor until the next read: of many films not all can be open.
    void rest() { file_.reset(); }

  private:
    std::filesystem::path path_;
    std::optional<InputFile> file_;
    Film film_;
    ProgressSizes sizes_;
    std::uint64_t header_end_ = 0;
    std::string header_sum_;

    void read_header();
    /// Open, and still the film that it was.
    InputFile& file();
};

}  // namespace triad
