#pragma once
/// References of `triad bench error`, as film files in the cache folder.
#include <optional>
#include <string>

#include "scene/film.h"

namespace triad {

/// None where there is none, or what is there cannot be read (which is said).
std::optional<Film> load_reference(const std::string& key);

/// Written aside and renamed. That it cannot be kept is a warning.
void keep_reference(const std::string& key, const Film& film);

}  // namespace triad
