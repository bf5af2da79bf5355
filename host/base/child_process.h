#pragma once
/// Programs of others, run and waited for.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

  private:
    std::filesystem::path path_;
};

/// Runs `arguments[0]`, found along PATH, without a shell and without input, and waits; what it prints goes
/// to the two files. Its exit status (128 + signal when a signal ended it), or nothing when there is no such
/// program.
std::optional<int> run_program(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                               const std::filesystem::path& errors);

}  // namespace triad
