// Large pieces of memory, which the system is asked to back by pages of megabytes.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/aligned_vector.h"
#include "base/freed_memory.h"
#include "base/huge_pages.h"

using namespace triad;

namespace {

constexpr std::size_t megabyte = 1 << 20;

/// The line "VmFlags:" of the mapping that holds an address (proc_pid_smaps(5)).
std::string flags_of(const void* address) {
    std::ifstream maps("/proc/self/smaps");
    const auto wanted = reinterpret_cast<std::uintptr_t>(address);
    bool is_there = false;
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        if (std::istringstream range(line); range >> std::hex >> begin >> dash >> end && dash == '-')
            is_there = begin <= wanted && wanted < end;
        if (is_there && line.starts_with("VmFlags:")) return line + " ";
    }
    return "";
}

bool asked_for(const void* begin, std::size_t bytes) {
    return flags_of(static_cast<const char*>(begin) + bytes / 2).find(" hg ") != std::string::npos;
}

}  // namespace

TEST(HugePages, are_asked_for_where_a_piece_is_large) {
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage"))
        GTEST_SKIP() << "This system has no huge pages to ask for.";
    keep_no_large_pieces();  // as programs do: a piece is then a mapping of its own
    const std::vector<char> plain(16 * megabyte);
    if (flags_of(plain.data()).empty()) GTEST_SKIP() << "This system does not say what was asked for.";
    EXPECT_TRUE(asked_for(plain.data(), plain.size()));
    const AlignedVector<char> aligned(16 * megabyte);
    EXPECT_TRUE(asked_for(aligned.data(), aligned.size()));
    // Of the system itself, since a small piece may lie where a large one was before.
    void* small = ::mmap(nullptr, 3 * megabyte, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(small, MAP_FAILED);
    prefer_huge_pages(small, 3 * megabyte);
    EXPECT_FALSE(asked_for(small, 3 * megabyte));
    ::munmap(small, 3 * megabyte);
}
