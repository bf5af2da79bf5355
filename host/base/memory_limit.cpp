#include "base/memory_limit.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>

#include "base/error.h"
#include "base/text.h"

namespace triad {
namespace {

std::atomic<std::uint64_t> most = 0;
std::atomic<std::int64_t> in_use = 0;

}  // namespace

std::uint64_t available_memory() {
    std::uint64_t bytes = std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGE_SIZE));
    std::ifstream group("/sys/fs/cgroup/memory.max");  // "max" is none
    if (std::uint64_t allowed = 0; group >> allowed) bytes = std::min(bytes, allowed);
    return bytes;
}

void set_memory_limit(std::uint64_t bytes) { most = bytes; }
std::uint64_t memory_limit() { return most; }
std::uint64_t memory_in_use() { return std::uint64_t(std::max<std::int64_t>(in_use, 0)); }
void count_memory(std::int64_t bytes) { in_use += bytes; }

void require_memory(std::uint64_t bytes, const std::string& what) {
    const std::uint64_t used = memory_in_use();
    if (most == 0 || (bytes <= most && used <= most - bytes)) return;
    throw Error(Exit::memory,
                what + " needs " + bytes_text(bytes) + ", and " + bytes_text(used) +
                    " are in use: more than the " + bytes_text(most) +
                    " of --max-memory (half of the machine's, unless it is given). Use a smaller picture "
                    "or scene, or a larger --max-memory.");
}

}  // namespace triad
