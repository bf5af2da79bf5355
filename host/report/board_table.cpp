#include "report/board_table.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "page/aligned.h"

namespace triad {
namespace {

/// Whether the measures are the same one; at whatever number of samples, which is as many as there was time
/// for.
bool is_same_measure(const BoardLine& line, const BoardRow& row) {
    return line.name == row.name && line.way == way_of(row);
}

/// Efficiency where errors are compared: those fall by time.
double rate_of(const BoardRow& row) {
    return is_time(row.unit) || row.part == BoardPart::error ? 1 / row.value.value : row.value.value;
}

}  // namespace

std::optional<double> BoardLine::speed_of(std::size_t board) const {
    if (!of_board[0] || !of_board[board] || part == BoardPart::check) return {};
    if (of_board[0]->spp != of_board[board]->spp) return {};  // efficiency depends on how far a run went
    const double speed = rate_of(*of_board[board]) / rate_of(*of_board[0]);
    return std::isfinite(speed) && speed > 0 ? std::optional(speed) : std::nullopt;
}

std::vector<BoardLine> lines_of(const std::vector<Board>& boards, BoardPart part) {
    std::vector<BoardLine> lines;
    for (std::size_t board = 0; board < boards.size(); ++board)
        for (const BoardRow* row : boards[board].of(part)) {
            auto line = std::find_if(lines.begin(), lines.end(),
                                     [&](const BoardLine& l) { return is_same_measure(l, *row); });
            if (line == lines.end())
                line = lines.insert(lines.end(), {part, row->name, way_of(*row), row->unit,
                                                  std::vector<const BoardRow*>(boards.size())});
            line->of_board[board] = row;
        }
    if (part == BoardPart::check)
        std::erase_if(lines, [](const BoardLine& line) {
            return std::all_of(line.of_board.begin(), line.of_board.end(),
                               [](const BoardRow* row) { return !row || row->is_right; });
        });
    return lines;
}

std::vector<BoardLine> best_lines(const std::vector<Board>& boards, BoardPart part) {
    std::vector<BoardLine> best;
    for (const BoardLine& line : lines_of(boards, part)) {
        auto same = std::ranges::find(best, line.name, &BoardLine::name);
        if (same == best.end()) {
            best.push_back(line);
            best.back().way.clear();
            continue;
        }
        for (std::size_t board = 0; board < boards.size(); ++board) {
            const BoardRow *&kept = same->of_board[board], *row = line.of_board[board];
            if (row && (!kept || rate_of(*row) > rate_of(*kept))) kept = row;
        }
    }
    return best;
}

std::string board_letter(std::size_t board) {
    return std::string(1, char('A' + board % 26)) + (board < 26 ? "" : std::to_string(board / 26 + 1));
}

std::string answers_text(const Board& board) {
    const auto answers = board.of(BoardPart::check);
    const auto wrong =
        std::count_if(answers.begin(), answers.end(), [](const BoardRow* r) { return !r->is_right; });
    if (answers.empty()) return "not checked";
    return (wrong > 0 ? std::to_string(wrong) + " of " : "") + std::to_string(answers.size()) +
           (wrong > 0 ? " answers WRONG" : " answers right");
}

std::string value_text(const BoardLine& line, std::size_t board) {
    const BoardRow* row = line.of_board[board];
    if (!row) return "-";
    std::string text = format("%.4g", row->value.value);
    if (const auto speed = line.speed_of(board); speed && board > 0) text += format(" (x%.3g)", *speed);
    return text + (row->is_right ? "" : " WRONG");
}

std::string table_of(const std::vector<Board>& boards) {
    std::string text;
    for (std::size_t i = 0; i < boards.size(); ++i) {
        const Board& b = boards[i];
        text += (boards.size() > 1 ? board_letter(i) + ": " : "") + b.device + ", " + b.platform +
                ", driver " + b.driver + "\n   " + b.machine + "; Triad " + b.version + "; " +
                format("%.0f s; ", b.seconds) + answers_text(b) + "\n";
    }
    for (const BoardPart part : all_board_parts) {
        const std::vector<BoardLine> lines = lines_of(boards, part);
        if (lines.empty() || part == BoardPart::error) continue;
        std::vector<std::vector<std::string>> cells{{title_of(part), "", ""}};
        for (std::size_t i = 0; i < boards.size(); ++i)
            cells[0].push_back(boards.size() > 1 ? board_letter(i) : "");
        for (const BoardLine& line : lines) {
            cells.push_back({line.name, line.way, line.unit});
            for (std::size_t i = 0; i < boards.size(); ++i) cells.back().push_back(value_text(line, i));
        }
        text += "\n" + aligned(cells, 3);
    }
    if (boards.size() > 1) text += "\n(xN): N times as fast as A\n";
    for (std::size_t i = 0; i < boards.size(); ++i)
        for (const std::string& sentence : boards[i].left_out)
            text += "\n" + (boards.size() > 1 ? board_letter(i) + ": " : std::string()) + sentence;
    return text + (text.ends_with("\n") ? "" : "\n");
}

}  // namespace triad
