#pragma once
/// Boards side by side: what is printed, and what the page's tables and plots are made of.
#include <optional>
#include <string>
#include <vector>

#include "bench/board.h"

namespace triad {

/// A measure, and what each board has of it.
struct BoardLine {
    BoardPart part;
    std::string name, way, unit;
    std::vector<const BoardRow*> of_board;  ///< null: that board has none

    /// How many times as fast as the first board another is; none where one of them has no such row.
    std::optional<double> speed_of(std::size_t board) const;
};

/// Lines of a part, in the order in which the first board that has them does. Of known answers only those
/// that some board gives wrong; of errors the last point of each curve.
std::vector<BoardLine> lines_of(const std::vector<Board>& boards, BoardPart part);

/// For each name the line of the way that is fastest on each board: `way` is empty.
std::vector<BoardLine> best_lines(const std::vector<Board>& boards, BoardPart part);

/// "A" to "Z", then "A2" ...
std::string board_letter(std::size_t board);
/// "68 answers right", "2 of 68 answers wrong", "not checked".
std::string answers_text(const Board& board);
/// "12.3", of several boards "12.3 (x1.8)".
std::string value_text(const BoardLine& line, std::size_t board);

/// For a terminal.
std::string table_of(const std::vector<Board>& boards);

}  // namespace triad
