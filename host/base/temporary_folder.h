#pragma once
#include <filesystem>
#include <string>

namespace triad {

/// A new folder below the system's temporary one, removed with all that is in it.
class TemporaryFolder {
  public:
    /// Throws Error(scene) when it cannot be made.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

}  // namespace triad
