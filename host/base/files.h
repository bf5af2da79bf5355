#pragma once
/// Files of the outside world: size-capped reads, and writes that never leave half a file behind.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace triad {

/// The bytes of a regular file of at most `cap` bytes. Throws Error(scene) that names the path otherwise.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::uint64_t cap = std::uint64_t(16)
                                                                                           << 30);

/// The same of one that must not be empty.
std::vector<std::uint8_t> read_filled_file(const std::filesystem::path& path, std::uint64_t cap);

/// Whether something, a regular file, a folder is there. What cannot be asked (a name that is too long, a
/// folder that may not be entered) is not.
bool is_there(const std::filesystem::path& path);
bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);

/// Calls write(temporary path in the same folder) and renames the result onto `path`; on any exception the
/// temporary is removed and an older file at `path` stays as it was. An existing device or pipe is written to
/// directly. Throws Error(scene) when the folder cannot be written.
void write_aside(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path&)>& write);

/// A regular file. Movable. Throws Error(scene) that names the path.
class InputFile {
  public:
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&& other) noexcept;

    std::uint64_t size() const { return size_; }
    /// The next bytes are those from here on.
    void seek(std::uint64_t at);
    /// The next bytes; it is an error when they are not there.
    void read(void* to, std::size_t bytes);

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

using ByteSink = std::function<void(std::string_view)>;
/// write_aside of what `produce` gives to the sink, piece by piece, checked and synchronised.
void write_file(const std::filesystem::path& path, const std::function<void(const ByteSink&)>& produce);
/// write_aside of these bytes, checked to the last one (a full disk is an Error(scene)).
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Removes what processes that died while they wrote `path` left beside it. `all`: nobody writes it now, so
/// that every such file is a leftover; else those of processes that are gone from this machine for a minute.
void remove_leftovers(const std::filesystem::path& path, bool all);

/// Whether a file was last written more than a day ago, or cannot be asked.
bool is_older_than_a_day(const std::filesystem::path& path);

/// $XDG_CACHE_HOME/triad or ~/.cache/triad, created on demand. Where neither can be written: a temporary
/// folder of this process, which a warning tells; empty when there is none either (then nothing is cached).
std::filesystem::path cache_folder();
/// What is put into that folder is there in later runs, and in other processes.
bool keeps_cache();

}  // namespace triad
