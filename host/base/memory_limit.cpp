#include "base/memory_limit.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>

#include "base/error.h"
#include "base/text.h"

namespace triad {
namespace {

/// Smaller pieces are not counted: counting them would take more time than getting them.
constexpr std::size_t large = 64 << 10;
/// Smaller pieces are not refused: compilers of drivers end the process where they get none.
constexpr std::size_t refusable = 1 << 20;

std::atomic<std::uint64_t> most = 0;
std::atomic<std::int64_t> in_use = 0;

class BeyondLimit : public std::bad_alloc {
  public:
    const char* what() const noexcept override {
        return "There is not enough memory: what --max-memory allows (half of the machine's, unless it is "
               "given) is in use. "
               "Use a smaller picture or scene, or a larger --max-memory.";
    }
};

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    if (const std::size_t bytes = ::malloc_usable_size(memory); bytes >= large) in_use += std::int64_t(bytes);
    return memory;
}

void require_room(std::size_t bytes) {
    if (bytes >= refusable && most > 0 && in_use + std::int64_t(bytes) > std::int64_t(most))
        throw BeyondLimit();
}

void release(void* memory) {
    if (!memory) return;
    if (const std::size_t bytes = ::malloc_usable_size(memory); bytes >= large) in_use -= std::int64_t(bytes);
    std::free(memory);
}

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

void* operator new(std::size_t bytes) {
    triad::require_room(bytes);
    return triad::counted(std::malloc(bytes > 0 ? bytes : 1));
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
    triad::require_room(bytes);
    const auto unit = std::size_t(alignment);
    return triad::counted(std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit));
}

void operator delete(void* memory) noexcept { triad::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { triad::release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { triad::release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { triad::release(memory); }
