#include "base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/log.h"

namespace triad {
namespace {

/// What a holder wrote: who it is.
std::string text_in(int descriptor) {
    char text[256];
    const ssize_t n = ::pread(descriptor, text, sizeof text, 0);
    return n > 0 ? std::string(text, std::size_t(n)) : "another process";
}

void sign(int descriptor) {
    char host[128] = "";
    ::gethostname(host, sizeof host - 1);
    const std::string text = "process " + std::to_string(::getpid()) + " on " + host;
    // For the sentence that another process prints; the lock holds without it.
    if (::ftruncate(descriptor, 0) == 0) {
        [[maybe_unused]] const ssize_t written = ::pwrite(descriptor, text.data(), text.size(), 0);
    }
}

/// Whether the name still leads to the open file: its last holder may have removed it meanwhile.
bool is_there(const std::filesystem::path& path, int descriptor) {
    struct stat mine {
    }, there{};
    return ::fstat(descriptor, &mine) == 0 && ::stat(path.c_str(), &there) == 0 &&
           mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
}

std::filesystem::path lock_of(const std::filesystem::path& path) {
    return path.parent_path() / ("." + path.filename().string() + ".lock");
}

}  // namespace

void FileLock::clear(const std::filesystem::path& path) {
    std::error_code failed;
    if (std::filesystem::exists(lock_of(path), failed)) const FileLock taken(path);
}

FileLock::FileLock(const std::filesystem::path& path) : lock_(lock_of(path)) {
    for (;;) {
        descriptor_ = ::open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0)
            throw Error(Exit::scene,
                        "Cannot write " + lock_.string() + ": " + std::string(std::strerror(errno)) + ".");
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
            const int why = errno;
            const std::string holder = text_in(descriptor_);
            ::close(descriptor_);
            descriptor_ = -1;
            if (why == EWOULDBLOCK)
                throw Error(Exit::scene, path.string() + " is in use: " + holder +
                                             " renders onto it. Wait for it, or name another film.");
            detail("Nothing keeps other processes from writing " + path.string() + ": " + std::strerror(why));
            return;
        }
        if (is_there(lock_, descriptor_)) break;
        ::close(descriptor_);
    }
    sign(descriptor_);
}

FileLock::~FileLock() {
    if (descriptor_ < 0) return;
    std::error_code ignored;
    std::filesystem::remove(lock_, ignored);  // while it is held, so that nobody else's goes
    ::close(descriptor_);
}

}  // namespace triad
