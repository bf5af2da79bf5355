#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace triad {

/// XXH3-128 of what is added, in order; names caches, scenes and settings. Not cryptographic.
class Hash {
  public:
    Hash();
    ~Hash();
    Hash(const Hash&) = delete;
    Hash& operator=(const Hash&) = delete;

    Hash& add(const void* data, std::size_t size);
    Hash& add(std::string_view text);  ///< length first, so that ("ab", "c") differs from ("a", "bc")
    template <class T>
    Hash& add_value(const T& value) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
        return add(&value, sizeof value);
    }
    std::string hex() const;  ///< 32 lower-case digits

  private:
    void* state_;
};

}  // namespace triad
