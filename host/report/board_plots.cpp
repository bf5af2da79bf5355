#include "report/board_plots.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "page/gnuplot.h"
#include "report/board_table.h"

namespace triad {
namespace {

/// What is said of a board by a few points: what its users wait for.
constexpr BoardPart plotted_parts[] = {BoardPart::peak, BoardPart::rays, BoardPart::paths, BoardPart::display,
                                       BoardPart::efficiency};

void add_curve(ErrorBench& bench, const Board& board, const std::string& scene, const std::string& way,
               const std::string& setting) {
    ErrorCurve curve;
    curve.scene = scene, curve.setting = setting;
    for (const BoardRow* row : board.of(BoardPart::error))
        if (row->name == scene && way_of(*row) == way)
            curve.points.push_back({.spp = row->spp, .seconds = row->seconds, .relmse = row->value});
    for (const BoardRow* row : board.of(BoardPart::efficiency))
        if (row->name == scene && way_of(*row) == way) curve.efficiency = row->value;
    if (!curve.points.empty()) bench.curves.push_back(std::move(curve));
}

std::string title_of(const BoardLine& line) {
    return line.part == BoardPart::efficiency ? "error for time, " + line.name
           : line.part == BoardPart::rays     ? "rays, " + line.name
           : line.part == BoardPart::paths    ? "paths, " + line.name
                                              : line.name;
}

}  // namespace

ErrorBench error_bench_of(const std::vector<Board>& boards) {
    ErrorBench bench;
    const auto add_setting = [&](const std::string& name) {
        if (std::ranges::find(bench.settings, name, &ErrorSetting::name) == bench.settings.end())
            bench.settings.push_back({.name = name});
    };
    const auto best = best_lines(boards, BoardPart::efficiency);
    for (const BoardLine& line : best) bench.scenes.push_back({.name = line.name});
    for (std::size_t i = 0; i < boards.size(); ++i)
        for (const BoardLine& line : best) {
            if (boards.size() > 1 && line.of_board[i]) {
                add_setting(board_letter(i));
                add_curve(bench, boards[i], line.name, way_of(*line.of_board[i]), board_letter(i));
            }
            if (boards.size() > 1) continue;
            for (const BoardRow* row : boards[i].of(BoardPart::efficiency))
                if (row->name == line.name) {
                    add_setting(way_of(*row));
                    add_curve(bench, boards[i], line.name, way_of(*row), way_of(*row));
                }
        }
    return bench;
}

std::string speed_plot_script(const std::vector<Board>& boards) {
    if (boards.size() < 2) return "";
    std::vector<std::string> data(boards.size());
    std::string ticks;
    unsigned row = 0;
    double low = 1, high = 1;
    for (const BoardPart part : plotted_parts)
        for (const BoardLine& line : best_lines(boards, part)) {
            if (!line.of_board[0]) continue;
            ticks += (ticks.empty() ? "" : ", ") + gnuplot_quoted(title_of(line)) + format(" %d", -int(row));
            for (std::size_t i = 0; i < boards.size(); ++i) {
                const auto speed = line.speed_of(i);
                if (!speed) continue;
                data[i] += format("%.9g %d\n", *speed, -int(row));
                low = std::min(low, *speed), high = std::max(high, *speed);
            }
            ++row;
        }
    if (row == 0) return "";
    std::string script = plot_head("Speed", 140 + 19.0 * (row + boards.size()));
    script +=
        "set logscale x 10\nset format x '%g'\nset xlabel 'times as fast as A'\nset key tmargin center\n";
    script += "set ytics (" + ticks + ") scale 0\n";
    script += format("set xrange [%.9g:%.9g]\nset yrange [%d:1]\n", low / 1.5, high * 1.5, -int(row));
    std::string plots;
    for (std::size_t i = 0; i < boards.size(); ++i) {
        if (data[i].empty()) continue;
        script += format("$board%zu << EOD\n", i) + data[i] + "EOD\n";
        plots += (plots.empty() ? "plot " : ", ") +
                 format("$board%zu using 1:2 with points pt %u ps 0.9 lc rgb '%s' title ", i,
                        unsigned(5 + 2 * (i % 5)), pen_of(i).colour) +
                 gnuplot_quoted(board_letter(i));
    }
    return script + plots + "\n";
}

}  // namespace triad
