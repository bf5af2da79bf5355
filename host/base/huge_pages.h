#pragma once
#include <cstddef>

namespace triad {

/// Asks the system to back a large piece of memory, of which nothing has been touched (a mapping of its own:
/// keep_no_large_pieces()), by pages of megabytes, which are there sooner. Small pieces and systems without
/// such pages: nothing happens.
void prefer_huge_pages(void* memory, std::size_t bytes);

}  // namespace triad
