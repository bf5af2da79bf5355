#include "film_table.h"

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "base/hash.h"

namespace triad {
namespace {

template <class T>
std::string hash_of(const std::vector<T>& array) {
    return Hash().add(array.data(), array.size() * sizeof(T)).hex().substr(0, 16);
}

std::vector<std::string> lines_of_table() {
    std::ifstream file(film_table_file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

const std::string driver_key = "driver: ";

/// "sums half-sums samples name: options"; none: a comment or an empty line.
std::optional<FilmCase> read_case(const std::string& line) {
    if (line.empty() || line[0] == '#' || line.starts_with(driver_key)) return {};
    FilmCase found;
    std::istringstream words(line);
    words >> found.expected.sums >> found.expected.half_sums >> found.expected.samples >> found.name;
    std::getline(words >> std::ws, found.options);
    if (!found.name.ends_with(':'))
        throw std::runtime_error(film_table_file.string() + " has a line that is no case: " + line);
    found.name.pop_back();
    return found;
}

std::string line_of(const FilmCase& c) {
    return c.expected.sums + " " + c.expected.half_sums + " " + c.expected.samples + " " + c.name + ": " +
           c.options;
}

}  // namespace

ArrayHashes hashes_of(const Film& film) {
    return {hash_of(film.sums), hash_of(film.half_sums), hash_of(film.samples)};
}

std::string differences(const ArrayHashes& a, const ArrayHashes& b) {
    std::string all;
    const auto add = [&](const char* what, bool differs) {
        if (differs) all += (all.empty() ? "" : ", ") + std::string(what);
    };
    add("sums", a.sums != b.sums);
    add("half sums", a.half_sums != b.half_sums);
    add("sample numbers", a.samples != b.samples);
    return all;
}

FilmTable load_film_table() {
    FilmTable table;
    for (const std::string& line : lines_of_table()) {
        if (line.starts_with(driver_key)) table.driver = line.substr(driver_key.size());
        if (const auto c = read_case(line)) table.cases.push_back(*c);
    }
    return table;
}

void renew(const FilmCase& changed, const std::string& driver) {
    std::vector<std::string> lines = lines_of_table();
    for (std::string& line : lines) {
        if (line.starts_with(driver_key)) line = driver_key + driver;
        const auto c = read_case(line);
        if (c && c->name == changed.name) line = line_of(changed);
    }
    std::ofstream file(film_table_file);
    for (const std::string& line : lines) file << line << "\n";
    if (!file.flush()) throw std::runtime_error("cannot write " + film_table_file.string());
}

}  // namespace triad
