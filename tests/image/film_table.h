#pragma once
/// film_hashes.txt: what arrays the films of many scenes and options have.
#include <filesystem>
#include <string>
#include <vector>

#include "scene/film.h"

namespace triad {

/// First 16 digits of XXH3-128.
struct ArrayHashes {
    std::string sums, half_sums, samples;
    bool operator==(const ArrayHashes&) const = default;
};
ArrayHashes hashes_of(const Film& film);
/// "sums, half sums": what differs.
std::string differences(const ArrayHashes& a, const ArrayHashes& b);

struct FilmCase {
    std::string name;
    /// Of `triad render`, with the names of kept_options.h. What stands after each |, if any, makes a part of
    /// its own, and the parts are merged.
    std::string options;
    ArrayHashes expected;
};

struct FilmTable {
    std::string driver;  ///< "device, version", as films name it
    std::vector<FilmCase> cases;
};

inline const std::filesystem::path film_table_file = TRIAD_SOURCE_DIR "/tests/image/film_hashes.txt";
/// Throws std::runtime_error for a line that is no case.
FilmTable load_film_table();
/// Replaces the hashes of one case in the file, and the driver.
void renew(const FilmCase& changed, const std::string& driver);

}  // namespace triad
