#include "base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace triad {

void prefer_huge_pages(void* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t huge = 2 << 20;
    if (bytes < 2 * huge) return;
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (begin + huge - 1) / huge * huge, end = (begin + bytes) / huge * huge;
    ::madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);  // advice: no harm if refused
#else
    (void)memory, (void)bytes;
#endif
}

}  // namespace triad
