#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/temporary_folder.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

struct Descriptor {
    int fd;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

std::string reason() { return std::strerror(errno); }

}  // namespace

InputFile::InputFile(const fs::path& path) : path_(path) {
    // O_NONBLOCK: opening a FIFO must not hang; the type is checked on the open descriptor, not on the name.
    Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    if (file.fd < 0) throw Error(Exit::scene, "Cannot open " + path.string() + ": " + reason() + ".");
    struct stat status {};
    if (::fstat(file.fd, &status) != 0)
        throw Error(Exit::scene, "Cannot stat " + path.string() + ": " + reason() + ".");
    if (!S_ISREG(status.st_mode)) throw Error(Exit::scene, path.string() + " is not a regular file.");
    size_ = static_cast<std::uint64_t>(status.st_size);
    std::swap(descriptor_, file.fd);
}

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

InputFile::InputFile(InputFile&& other) noexcept { *this = std::move(other); }

InputFile& InputFile::operator=(InputFile&& other) noexcept {
    std::swap(path_, other.path_), std::swap(descriptor_, other.descriptor_), std::swap(size_, other.size_);
    return *this;
}

void InputFile::seek(std::uint64_t at) {
    if (::lseek(descriptor_, off_t(at), SEEK_SET) < 0)
        throw Error(Exit::scene, "Cannot read " + path_.string() + ": " + reason() + ".");
}

void InputFile::read(void* to, std::size_t bytes) {
    std::size_t done = 0;
    while (done < bytes) {
        const ssize_t n = ::read(descriptor_, static_cast<char*>(to) + done, bytes - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0)
            throw Error(Exit::scene, "Cannot read " + path_.string() + ": " +
                                         (n < 0 ? reason() : "it became shorter") + ".");
        done += static_cast<std::size_t>(n);
    }
}

std::vector<std::uint8_t> read_file(const fs::path& path, std::uint64_t cap) {
    InputFile file(path);
    if (file.size() > cap)
        throw Error(Exit::scene, path.string() + " has " + std::to_string(file.size()) +
                                     " bytes; the limit is " + std::to_string(cap) + ".");
    std::vector<std::uint8_t> bytes(file.size());
    file.read(bytes.data(), bytes.size());
    return bytes;
}

std::vector<std::uint8_t> read_filled_file(const fs::path& path, std::uint64_t cap) {
    std::vector<std::uint8_t> bytes = read_file(path, cap);
    if (bytes.empty()) throw Error(Exit::scene, path.string() + " is empty.");
    return bytes;
}

namespace {

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// The name under which process `pid` writes the file. The extension stays last: image writers choose the
/// format by it.
std::string name_aside(const fs::path& path, const std::string& pid) {
    return "." + path.stem().string() + ".part" + pid + path.extension().string();
}

}  // namespace

bool is_there(const fs::path& path) {
    std::error_code failed;
    return fs::exists(path, failed);
}
bool is_file(const fs::path& path) {
    std::error_code failed;
    return fs::is_regular_file(path, failed);
}
bool is_folder(const fs::path& path) {
    std::error_code failed;
    return fs::is_directory(path, failed);
}

void write_aside(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    const fs::path aside = folder_of(path) / name_aside(path, std::to_string(::getpid()));
    struct Cleanup {
        const fs::path& aside;
        ~Cleanup() {
            std::error_code ignored;
            fs::remove(aside, ignored);
        }
    } cleanup{aside};
    if (is_folder(path)) throw Error(Exit::scene, "Cannot write " + path.string() + ": it is a folder.");
    std::error_code ignored;
    if (const fs::file_status there = fs::status(path, ignored);
        fs::exists(there) && !fs::is_regular_file(there)) {
        write(path);  // a device or pipe is written to, not replaced
        return;
    }
    {
        Descriptor probe{::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
        if (probe.fd < 0) throw Error(Exit::scene, "Cannot write " + path.string() + ": " + reason() + ".");
    }
    write(aside);
    std::error_code failed;
    fs::rename(aside, path, failed);
    if (failed) throw Error(Exit::scene, "Cannot write " + path.string() + ": " + failed.message() + ".");
}

void write_file(const fs::path& path, const std::function<void(const ByteSink&)>& produce) {
    write_aside(path, [&](const fs::path& aside) {
        Descriptor file{::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
        const auto fail = [&] {
            throw Error(Exit::scene, "Cannot write " + path.string() + ": " + reason() + ".");
        };
        if (file.fd < 0) fail();
        produce([&](std::string_view bytes) {
            std::size_t done = 0;
            while (done < bytes.size()) {
                const ssize_t n = ::write(file.fd, bytes.data() + done, bytes.size() - done);
                if (n < 0 && errno == EINTR) continue;
                if (n <= 0) fail();
                done += static_cast<std::size_t>(n);
            }
        });
        // Pipes and devices cannot be synchronised: EINVAL.
        if (::fsync(file.fd) != 0 && errno != EINVAL) fail();
    });
}

void write_file(const fs::path& path, std::string_view bytes) {
    write_file(path, [&](const ByteSink& write) { write(bytes); });
}

void remove_leftovers(const fs::path& path, bool all) {
    const std::string begin = "." + path.stem().string() + ".part", end = path.extension().string();
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(path), failed)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end))
            continue;
        const std::string pid = name.substr(begin.size(), name.size() - begin.size() - end.size());
        if (pid.size() > 9 || pid.find_first_not_of("0123456789") != std::string::npos) continue;
        const bool is_gone = ::kill(std::stoi(pid), 0) != 0 && errno == ESRCH;
        const auto age = fs::file_time_type::clock::now() - entry.last_write_time(failed);
        if (all || (is_gone && age > std::chrono::minutes(1))) fs::remove(entry.path(), failed);
    }
}

bool is_older_than_a_day(const fs::path& path) {
    std::error_code failed;
    const auto written = fs::last_write_time(path, failed);
    return failed || fs::file_time_type::clock::now() - written > std::chrono::hours(24);
}

namespace {

std::atomic<bool> uses_temporary_cache = false;

/// The cache folder that this process has when the user's cannot be written.
fs::path temporary_cache(const std::string& why) {
    uses_temporary_cache = true;
    static const std::unique_ptr<TemporaryFolder> folder = []() -> std::unique_ptr<TemporaryFolder> {
        try {
            return std::make_unique<TemporaryFolder>();
        } catch (const Error&) {
            return nullptr;
        }
    }();
    warn("Nothing can be kept for later runs: " + why +
         ". XDG_CACHE_HOME names a folder for it; this run uses a temporary one and does all again that is "
         "done once.");
    return folder ? folder->path() : fs::path{};
}

}  // namespace

bool keeps_cache() {
    const fs::path folder = cache_folder();
    return !folder.empty() && !uses_temporary_cache;
}

fs::path cache_folder() {
    fs::path base;
    // The specification has relative ones ignored.
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && fs::path(xdg).is_absolute()) {
        base = xdg;
    } else if (const char* home = std::getenv("HOME"); home && *home) {
        base = fs::path(home) / ".cache";
    } else {
        return temporary_cache("neither XDG_CACHE_HOME (an absolute path) nor HOME is set");
    }
    base /= "triad";
    std::error_code failed;
    fs::create_directories(base, failed);
    if (!failed && ::access(base.c_str(), W_OK | X_OK) != 0) failed = {errno, std::generic_category()};
    return failed ? temporary_cache(base.string() + " cannot be written (" + failed.message() + ")") : base;
}

}  // namespace triad
