#pragma once
/// Boards as one page that needs nothing else.
#include <string>
#include <vector>

#include "bench/board.h"

namespace triad {

/// HTML: what was measured, side by side, and plots. `command`: what made it. Warns where gnuplot is missing.
std::string board_page(const std::vector<Board>& boards, const std::string& command);

}  // namespace triad
