#pragma once
/// Boards as the JSON of `triad bench device`, and back.
#include <filesystem>
#include <vector>

#include "bench/board.h"
#include "report/report.h"

namespace triad {

/// The rows of triad.bench-device/1; `board` is a place in boards_json().
Json rows_of(const std::vector<Board>& boards);
Json boards_json(const std::vector<Board>& boards);

/// What --json wrote. Throws Error(scene) with a sentence for anything else.
std::vector<Board> read_boards(const std::filesystem::path& path);

}  // namespace triad
