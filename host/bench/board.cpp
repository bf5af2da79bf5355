#include "bench/board.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace triad {
namespace {

struct PartWords {
    const char *name, *title;
};
constexpr PartWords part_words[] = {
    {"check", "Known answers"},
    {"peak", "Peaks"},
    {"rays", "Rays"},
    {"paths", "Paths"},
    {"stage", "Kernels of the path tracer"},
    {"display", "From bins to pixels"},
    {"function", "Functions alone"},
    {"error", "Error against time"},
    {"efficiency", "Efficiency"},
};
static_assert(std::size(part_words) == std::size(all_board_parts));

}  // namespace

std::string name_of(BoardPart part) { return part_words[std::size_t(part)].name; }
std::string title_of(BoardPart part) { return part_words[std::size_t(part)].title; }

BoardPart board_part(const std::string& name) {
    for (const BoardPart part : all_board_parts)
        if (name_of(part) == name) return part;
    throw std::invalid_argument("no part of a bench is called " + name);
}

std::string way_of(const BoardRow& row) {
    return row.path_driver + (row.path_driver.empty() || row.format.empty() ? "" : ", ") + row.format;
}

bool is_time(const std::string& unit) { return unit.starts_with("ms") || unit.starts_with("ns"); }

bool Board::is_right() const {
    return std::all_of(rows.begin(), rows.end(), [](const BoardRow& r) { return r.is_right; });
}

std::vector<const BoardRow*> Board::of(BoardPart part) const {
    std::vector<const BoardRow*> found;
    for (const BoardRow& row : rows)
        if (row.part == part) found.push_back(&row);
    return found;
}

}  // namespace triad
