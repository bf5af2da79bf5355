/// Films as files, whole.
#include <cstring>
#include <string>
#include <utility>

#include "base/error.h"
#include "io/film_blocks.h"

namespace triad {

bool is_film(const std::filesystem::path& path) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed)) return false;
    InputFile file(path);
    char start[sizeof film_magic];
    if (file.size() < sizeof start) return false;
    file.read(start, sizeof start);
    return std::memcmp(start, film_magic, sizeof film_magic) == 0;
}

namespace {

void write_film(const ByteSink& write, const Film& film) {
    // Blocks point into what they read or write; here nothing is changed.
    Film& readable = const_cast<Film&>(film);
    write_header(write, film);
    for (std::size_t i = 0; i < block_count(film); ++i) write_block(write, i, rows_of(readable, i));
    if (film.progress) write_block(write, block_count(film), block_of(*readable.progress));
}

}  // namespace

void save_film(const std::filesystem::path& path, const Film& film) {
    write_file(path, [&](const ByteSink& write) { write_film(write, film); });
}

std::string encode_film(const Film& film) {
    std::string bytes;
    write_film([&](std::string_view piece) { bytes += piece; }, film);
    return bytes;
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
                                     (found.film.progress && found.film.progress->words.empty()
                                          ? ", with the scene and the options that it was rendered with,"
                                          : "") +
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
