// The `new` and `delete` of programs: large pieces count, are refused beyond the limit on memory, and ask for
// huge pages.
#include <malloc.h>

#include <cstdlib>
#include <new>

#include "base/huge_pages.h"
#include "base/memory_limit.h"

namespace {

/// Smaller pieces are not counted: counting them would take more time than getting them.
constexpr std::size_t large = 64 << 10;
/// Smaller pieces are not refused: compilers of drivers end the process where they get none.
constexpr std::size_t refusable = 1 << 20;

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
    if (const std::size_t bytes = ::malloc_usable_size(memory); bytes >= large) {
        triad::count_memory(std::int64_t(bytes));
        triad::prefer_huge_pages(memory, bytes);
    }
    return memory;
}

void require_room(std::size_t bytes) {
    if (bytes < refusable) return;
    const std::uint64_t most = triad::memory_limit();
    if (most > 0 && triad::memory_in_use() + bytes > most) throw BeyondLimit();
}

void release(void* memory) {
    if (!memory) return;
    if (const std::size_t bytes = ::malloc_usable_size(memory); bytes >= large)
        triad::count_memory(-std::int64_t(bytes));
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t bytes) {
    require_room(bytes);
    return counted(std::malloc(bytes > 0 ? bytes : 1));
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
    require_room(bytes);
    const auto unit = std::size_t(alignment);
    return counted(std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit));
}

void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
