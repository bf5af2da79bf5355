#pragma once
#include <filesystem>

namespace triad {

/// Keeps other processes from writing a file, by a lock on `.NAME.lock` beside it, which ends with the
/// process however that ends. File systems without locks have none, which a detail tells.
class FileLock {
  public:
    /// Throws Error(scene) that names who holds it.
    explicit FileLock(const std::filesystem::path& path);
    ~FileLock();
    /// Removes the lock of a process that was killed. Throws as the constructor does where it lives.
    static void clear(const std::filesystem::path& path);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    std::filesystem::path lock_;
    int descriptor_ = -1;
};

}  // namespace triad
