#pragma once
/// A cache folder of one test's own: nothing that is kept for the user, or by another test, is read or
/// written.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/temporary_folder.h"

namespace triad {

/// XDG_CACHE_HOME is an empty temporary folder while this lives. Open devices first: drivers read the
/// variable too, when they start.
class OwnCache {
  public:
    OwnCache() {
        if (const char* value = std::getenv(variable)) before_ = value;
        ::setenv(variable, folder_.path().c_str(), 1);
    }
    ~OwnCache() { before_ ? ::setenv(variable, before_->c_str(), 1) : ::unsetenv(variable); }
    OwnCache(const OwnCache&) = delete;
    OwnCache& operator=(const OwnCache&) = delete;

    const std::filesystem::path& folder() const { return folder_.path(); }
    /// Where one kind of thing is kept, for example "taps".
    std::filesystem::path path(const std::string& room) const { return folder_.path() / "triad" / room; }
    /// All that is kept in one.
    std::vector<std::filesystem::path> files(const std::string& room) const {
        std::vector<std::filesystem::path> found;
        if (std::filesystem::exists(path(room)))
            for (const auto& entry : std::filesystem::directory_iterator(path(room)))
                found.push_back(entry.path());
        return found;
    }

  private:
    static constexpr const char* variable = "XDG_CACHE_HOME";
    TemporaryFolder folder_;
    std::optional<std::string> before_;
};

}  // namespace triad
