/// Films of ranges joined in flat memory: block by block, whatever their number and size.
#include <algorithm>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "io/film_blocks.h"
#include "kernels/types.h"

namespace triad {
namespace {

/// Files that are open at once; shells often allow 1024.
constexpr std::size_t most_open = 200;

/// Rows [begin, end) of a film, without a sample.
Film rows_like(const Film& film, unsigned begin, unsigned end) {
    Film rows = film;
    rows.height = end - begin;
    rows.sums.assign(rows.pixels() * rows.bins() * 4, 0);
    rows.half_sums.assign(rows.pixels() * 3, 0);
    rows.samples.assign(rows.pixels(), 0);
    if (film.has_guides) rows.guides.assign(rows.pixels() * DENOISE_GUIDES, 0);
    return rows;
}

/// In words: all rows that are lost from block `first` on, which is.
std::string damage_from(FilmReader& reader, std::size_t first) {
    SalvagedFilm found;
    for (std::size_t i = first; i < block_count(reader.film()); ++i) {
        const unsigned begin = unsigned(i * FILM_TILE),
                       end = std::min(begin + FILM_TILE, reader.film().height);
        Film rows = rows_like(reader.film(), begin, end);
        if (!reader.read(i, rows_of(rows, 0))) found.lost.push_back({begin, end});
    }
    return found.damage();
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

/// The estimated relMSE of a film that is seen in blocks of rows: each with those beside it, which hold all
/// the neighbours that estimates look at. Block by block it is summed in the order of the whole.
class BlockwiseError {
  public:
    void add(const Film& block) {
        window_.push_back(block);
        if (window_.size() > 3) window_.erase(window_.begin());
        if (window_.size() > 1) estimate(window_.size() - 2);
    }
    /// After the last block.
    double relmse() {
        if (!window_.empty()) estimate(window_.size() - 1);
        return pixels_ > 0 ? sum_ / double(pixels_) : -1;
    }

  private:
    std::vector<Film> window_;
    double sum_ = 0;
    std::size_t pixels_ = 0;

    void estimate(std::size_t which) {
        const std::size_t first = which > 0 ? which - 1 : 0, end = std::min(which + 2, window_.size());
        Film around = window_[first];
        for (std::size_t i = first + 1; i < end; ++i) {
            append(around.sums, window_[i].sums);
            append(around.half_sums, window_[i].half_sums);
            append(around.samples, window_[i].samples);
            around.height += window_[i].height;
        }
        const std::vector<float> errors = error_map(around);
        if (errors.empty()) return;
        const std::size_t before = which > first ? window_[first].pixels() : 0;
        for (std::size_t i = before; i < before + window_[which].pixels(); ++i) sum_ += errors[i];
        pixels_ += window_[which].pixels();
    }
};

}  // namespace

MergedFilm merge_films(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& output) {
    std::vector<FilmReader> readers;
    std::vector<Film> headers;
    std::vector<std::string> names;
    for (const std::filesystem::path& part : parts) {
        readers.emplace_back(part);
        headers.push_back(readers.back().film());
        names.push_back(part.string());
        if (parts.size() > most_open) readers.back().rest();
    }
    MergedFilm merged{merged_header(headers, names)};
    merged.film.progress.reset();
    BlockwiseError error;
    write_file(output, [&](const ByteSink& write) {
        write_header(write, merged.film);
        for (std::size_t i = 0; i < block_count(merged.film); ++i) {
            const unsigned begin = unsigned(i * FILM_TILE),
                           end = std::min(begin + FILM_TILE, merged.film.height);
            Film sum = rows_like(merged.film, begin, end);
            for (std::size_t part = 0; part < readers.size(); ++part) {
                Film rows = rows_like(headers[part], begin, end);
                if (!readers[part].read(i, rows_of(rows, 0)))
                    readers[part].refuse(damage_from(readers[part], i) + ". triad render --resume " +
                                         names[part] + " renders them again");
                const std::uint64_t count = headers[part].sample_count();
                for (const std::uint32_t n : rows.samples)
                    if (n != count) refuse_uneven(names[part]);
                if (part == first_part(headers)) sum.guides = rows.guides;
                add_sums(sum.sums, rows.sums);
                add_sums(sum.half_sums, rows.half_sums);
                for (std::size_t p = 0; p < sum.samples.size(); ++p) sum.samples[p] += rows.samples[p];
                if (parts.size() > most_open) readers[part].rest();
            }
            write_block(write, i, rows_of(sum, 0));
            error.add(sum);
        }
    });
    merged.relmse = error.relmse();
    return merged;
}

}  // namespace triad
