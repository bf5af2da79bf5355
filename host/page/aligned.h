#pragma once
/// Tables for a terminal.
#include <string>
#include <vector>

namespace triad {

/// Columns as wide as their widest text; the first `words` of them to the left, the others, numbers, to the
/// right. All lines have as many columns.
std::string aligned(const std::vector<std::vector<std::string>>& lines, std::size_t words);

}  // namespace triad
