#include "base/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "base/error.h"

namespace triad {

TemporaryFolder::TemporaryFolder() {
    std::error_code none;
    const std::filesystem::path place = std::filesystem::temp_directory_path(none);
    std::string pattern = (place / "triad-XXXXXX").string();
    if (none || !::mkdtemp(pattern.data()))
        throw Error(Exit::scene, "Cannot make a temporary folder like " + pattern + ": " +
                                     (none ? none.message() : std::strerror(errno)) +
                                     ". TMPDIR names another place for it.");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;  // what cannot be removed stays: a destructor has nobody to tell
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace triad
