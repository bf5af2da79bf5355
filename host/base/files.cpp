#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>

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

std::vector<std::uint8_t> read_file(const fs::path& path, std::uint64_t cap) {
    // O_NONBLOCK: opening a FIFO must not hang; the type is checked on the open descriptor, not on the name.
    Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    if (file.fd < 0) throw Error(Exit::scene, "Cannot open " + path.string() + ": " + reason() + ".");
    struct stat status {};
    if (::fstat(file.fd, &status) != 0)
        throw Error(Exit::scene, "Cannot stat " + path.string() + ": " + reason() + ".");
    if (!S_ISREG(status.st_mode)) throw Error(Exit::scene, path.string() + " is not a regular file.");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > cap)
        throw Error(Exit::scene, path.string() + " has " + std::to_string(size) + " bytes; the limit is " +
                                     std::to_string(cap) + ".");
    std::vector<std::uint8_t> bytes(size);
    std::uint64_t done = 0;
    while (done < size) {
        const ssize_t n = ::read(file.fd, bytes.data() + done, size - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0)
            throw Error(Exit::scene, "Cannot read " + path.string() + ": " +
                                         (n < 0 ? reason() : "it became shorter") + ".");
        done += static_cast<std::uint64_t>(n);
    }
    return bytes;
}

void write_aside(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    // The extension stays last: image writers choose the format by it.
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const fs::path aside = folder / ("." + path.stem().string() + ".part" + std::to_string(::getpid()) +
                                     path.extension().string());
    struct Cleanup {
        const fs::path& aside;
        ~Cleanup() {
            std::error_code ignored;
            fs::remove(aside, ignored);
        }
    } cleanup{aside};
    if (fs::is_directory(path))
        throw Error(Exit::scene, "Cannot write " + path.string() + ": it is a folder.");
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

void write_file(const fs::path& path, std::string_view bytes) {
    write_aside(path, [&](const fs::path& aside) {
        Descriptor file{::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
        std::size_t done = 0;
        while (file.fd >= 0 && done < bytes.size()) {
            const ssize_t n = ::write(file.fd, bytes.data() + done, bytes.size() - done);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) break;
            done += static_cast<std::size_t>(n);
        }
        // Pipes and devices cannot be synchronised: EINVAL.
        if (file.fd < 0 || done < bytes.size() || (::fsync(file.fd) != 0 && errno != EINVAL))
            throw Error(Exit::scene, "Cannot write " + path.string() + ": " + reason() + ".");
    });
}

bool is_older_than_a_day(const fs::path& path) {
    std::error_code failed;
    const auto written = fs::last_write_time(path, failed);
    return failed || fs::file_time_type::clock::now() - written > std::chrono::hours(24);
}

namespace {

/// The cache folder that this process has when the user's cannot be written.
fs::path temporary_cache(const std::string& why) {
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

fs::path cache_folder() {
    fs::path base;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) {
        base = xdg;
    } else if (const char* home = std::getenv("HOME"); home && *home) {
        base = fs::path(home) / ".cache";
    } else {
        return temporary_cache("neither XDG_CACHE_HOME nor HOME is set");
    }
    base /= "triad";
    std::error_code failed;
    fs::create_directories(base, failed);
    if (!failed && ::access(base.c_str(), W_OK | X_OK) != 0) failed = {errno, std::generic_category()};
    return failed ? temporary_cache(base.string() + " cannot be written (" + failed.message() + ")") : base;
}

}  // namespace triad
