#include "base/hash.h"

#define XXH_INLINE_ALL  // no library to link: triad-replay is carried to machines that lack it
#include <xxhash.h>

#include <cstdio>
#include <new>

namespace triad {
namespace {
XXH3_state_t* state(void* p) { return static_cast<XXH3_state_t*>(p); }
}  // namespace

Hash::Hash() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state(state_));
}

Hash::~Hash() { XXH3_freeState(state(state_)); }

Hash& Hash::add(const void* data, std::size_t size) {
    XXH3_128bits_update(state(state_), data, size);
    return *this;
}

Hash& Hash::add(std::string_view text) {
    const std::uint64_t size = text.size();
    add(&size, sizeof size);
    return add(text.data(), text.size());
}

std::string Hash::hex() const {
    const XXH128_hash_t h = XXH3_128bits_digest(state(state_));
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(h.high64),
                  static_cast<unsigned long long>(h.low64));
    return text;
}

}  // namespace triad
