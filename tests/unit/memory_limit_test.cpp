// The limit on memory, which large pieces keep.
#include <gtest/gtest.h>

#include <new>
#include <vector>

#include "base/aligned_vector.h"
#include "base/error.h"
#include "base/memory_limit.h"
#include "sentence_of.h"

using namespace triad;

namespace {

constexpr std::size_t megabyte = 1 << 20;

/// So many more megabytes than are in use, while it lives.
class Limit {
  public:
    explicit Limit(std::size_t megabytes) { set_memory_limit(memory_in_use() + megabytes * megabyte); }
    ~Limit() { set_memory_limit(0); }
};

}  // namespace

TEST(MemoryLimit, large_pieces_are_counted_and_refused_beyond_it) {
    const std::uint64_t before = memory_in_use();
    {
        const Limit limit(10);
        std::vector<char> first(6 * megabyte);
        EXPECT_GE(memory_in_use(), before + 6 * megabyte);
        EXPECT_THROW(std::vector<char>(6 * megabyte), std::bad_alloc);
        EXPECT_THROW(AlignedVector<char>(6 * megabyte), std::bad_alloc);
        EXPECT_EQ(new (std::nothrow) char[6 * megabyte], nullptr);
        first = std::vector<char>();
        const AlignedVector<char> second(6 * megabyte);
        EXPECT_GE(memory_in_use(), before + 6 * megabyte);
    }
    EXPECT_LT(memory_in_use(), before + megabyte);
    const std::vector<char> unlimited(60 * megabyte);
}

TEST(MemoryLimit, what_a_device_has_counts_and_what_is_needed_is_said) {
    const Limit limit(10);
    count_memory(6 * megabyte);
    EXPECT_THROW(std::vector<char>(6 * megabyte), std::bad_alloc);
    const std::string said = sentence_of(Exit::memory, [] { require_memory(6 * megabyte, "The film"); });
    EXPECT_NE(said.find("The film needs 6.3 MB"), std::string::npos) << said;
    require_memory(2 * megabyte, "The film");
    sentence_of(Exit::memory, [] { require_memory(~std::uint64_t(0), "The film"); });
    count_memory(-std::int64_t(6 * megabyte));
    require_memory(6 * megabyte, "The film");
}
