#pragma once
/// Vectors whose elements begin at a page: what is packed for devices lies in cache lines as it does on a
/// device, and a device that works in the host's memory uses it where it is (Device::share).
#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

namespace triad {

template <class T>
struct PageAllocator {
    using value_type = T;
    static constexpr std::align_val_t page{4096};

    PageAllocator() = default;
    template <class U>
    PageAllocator(const PageAllocator<U>&) {}

    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), page)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, page); }
    bool operator==(const PageAllocator&) const = default;
};

template <class T>
using AlignedVector = std::vector<T, PageAllocator<T>>;

/// Makes room for `count` more elements: exactly as much where that is much, so that a large vector never
/// lies beside its copy, and by a half at least, so that many small additions stay linear.
template <class T, class Allocator>
void reserve_more(std::vector<T, Allocator>& to, std::size_t count) {
    if (to.capacity() - to.size() < count) to.reserve(to.size() + std::max(count, to.size() / 2));
}

}  // namespace triad
