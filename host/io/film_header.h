#pragma once
/// The header of film files: a film without its arrays, as JSON.
#include <functional>
#include <string>

#include "scene/film.h"

namespace triad {

/// How many values of a film's progress follow its header.
struct ProgressSizes {
    std::uint64_t wanted = 0, set_errors = 0;
};

/// Sorted keys, no white space.
std::string film_header(const Film& film);

/// The film without its arrays and those of its progress. Calls `refuse`, which throws, with what is wrong.
Film film_of_header(const std::string& header, ProgressSizes& sizes,
                    const std::function<void(const std::string&)>& refuse);

}  // namespace triad
