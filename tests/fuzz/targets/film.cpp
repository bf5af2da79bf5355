// A film: a file of any bytes; and a header with sums behind a line break, whose checksums are made right.
#include <algorithm>
#include <cstring>

#include "base/hash.h"
#include "fuzz/targets/target.h"
#include "io/film_blocks.h"

using namespace triad;

namespace {

constexpr std::uint64_t most_values = 1 << 16;

void read(const std::filesystem::path& path) {
    if (!is_film(path)) return;
    load_film_header(path);
    salvage_film(path).damage();
    merge_films({path}, path.string() + ".merged");
}

/// The film of this header with values from `bytes`, as far as they last.
Film film_of(std::string_view header, std::string_view bytes) {
    std::string text(film_magic, sizeof film_magic);
    const std::uint32_t version = 2;
    const std::uint64_t length = header.size();
    text.append(reinterpret_cast<const char*>(&version), sizeof version);
    text.append(reinterpret_cast<const char*>(&length), sizeof length).append(header);
    text += Hash().add(header).hex();
    Film film = load_film_header(fuzz::file_of(text));
    const std::uint64_t pixels = film.pixels();
    if (pixels > most_values || film.bins() > most_values / std::max<std::uint64_t>(pixels, 1)) return film;
    film.sums.resize(pixels * film.bins() * 4), film.half_sums.resize(pixels * 3);
    film.samples.resize(pixels);
    if (film.progress) film.progress->wanted.resize(std::min(pixels, most_values));
    const auto fill = [&](auto& values) {
        const std::size_t size = std::min(values.size() * sizeof values[0], bytes.size());
        if (size > 0) std::memcpy(values.data(), bytes.data(), size);
        bytes.remove_prefix(size);
    };
    fill(film.samples), fill(film.half_sums), fill(film.sums);
    return film;
}

}  // namespace

TRIAD_FUZZ_TARGET(film) {
    fuzz::answer([](fuzz::Input bytes) { read(fuzz::file_of(bytes)); }, input);
    const std::string_view text = fuzz::text_of(input);
    const std::size_t end = std::min(text.find('\n'), text.size());
    const Film film = film_of(text.substr(0, end), text.substr(std::min(end + 1, text.size())));
    if (film.sums.empty()) return;
    const auto path = fuzz::file_of("");
    save_film(path, film);
    read(path);
    const Film back = load_film(path);
    estimated_relmse(back);
}
