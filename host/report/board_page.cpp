#include "report/board_page.h"

#include <algorithm>

#include "base/log.h"
#include "base/text.h"
#include "page/gnuplot.h"
#include "page/html.h"
#include "report/board_plots.h"
#include "report/board_table.h"
#include "report/error_plots.h"
#include "report/report.h"

namespace triad {
namespace {

std::string board_label(const std::vector<Board>& boards, std::size_t i) {
    return boards.size() > 1 ? board_letter(i) : "Value";
}

std::string boards_html(const std::vector<Board>& boards) {
    std::string html =
        "<table><thead><tr><th></th><th>Device</th><th>Driver</th><th>Machine</th><th>Answers</th></tr></"
        "thead>"
        "<tbody>\n";
    for (std::size_t i = 0; i < boards.size(); ++i) {
        const Board& b = boards[i];
        html += "<tr><th data-label=\"Board\">" + board_letter(i) + "</th>" + text_cell("Device", b.device) +
                text_cell("Driver", b.platform + ", " + b.driver) +
                text_cell("Machine", b.machine + "; Triad " + b.version) +
                "<td data-label=\"Answers\"><span class=\"v " + (b.is_right() ? "good" : "bad") + "\">" +
                answers_text(b) + format(", %.0f s</span></td></tr>\n", b.seconds);
    }
    return html + "</tbody></table>\n";
}

std::string part_html(const std::vector<Board>& boards, BoardPart part) {
    const std::vector<BoardLine> lines = lines_of(boards, part);
    if (lines.empty() || part == BoardPart::error) return "";
    const bool has_ways =
        std::any_of(lines.begin(), lines.end(), [](const BoardLine& l) { return !l.way.empty(); });
    std::string html = "<h2>" + title_of(part) + "</h2>\n<table><thead><tr><th></th>" +
                       (has_ways ? std::string("<th>By</th>") : "") + "<th>Unit</th>";
    for (std::size_t i = 0; i < boards.size(); ++i) html += "<th>" + board_label(boards, i) + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const BoardLine& line : lines) {
        html += "<tr><th data-label=\"\">" + html_escape(line.name) + "</th>" +
                (has_ways ? text_cell("By", line.way) : "") + text_cell("Unit", line.unit);
        for (std::size_t i = 0; i < boards.size(); ++i) {
            const BoardRow* row = line.of_board[i];
            html += number_cell(board_label(boards, i), value_text(line, i), row ? row->note : "");
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

std::string left_out_html(const std::vector<Board>& boards) {
    std::string items;
    for (std::size_t i = 0; i < boards.size(); ++i)
        for (const std::string& sentence : boards[i].left_out)
            items += "<li>" + (boards.size() > 1 ? board_letter(i) + ": " : std::string()) +
                     html_escape(sentence) + "</li>\n";
    return items.empty() ? "" : "<h2>Left out</h2>\n<ul>\n" + items + "</ul>\n";
}

/// Draws until something is missing.
class BoardFigures {
  public:
    std::string figure(const std::string& script, const std::string& words) {
        const std::string svg =
            script.empty() || !missing.empty() ? "" : draw_with_gnuplot(script, words, missing);
        return svg.empty() ? "" : svg_figure(svg, words);
    }

    std::string missing;
};

}  // namespace

std::string board_page(const std::vector<Board>& boards, const std::string& command) {
    BoardFigures figures;
    const ErrorBench errors = error_bench_of(boards);
    const std::string speeds = figures.figure(
        speed_plot_script(boards), "How many times as fast as A the boards are; further right is better");
    const std::string efficiency = figures.figure(efficiency_plot_script(errors, "1 / (relMSE x seconds)"),
                                                  "Efficiency, scene by scene");
    std::string plots;
    for (const ErrorScene& scene : errors.scenes)
        plots += figures.figure(error_plot_script(errors, scene.name, true),
                                "Relative error of " + scene.name + " against seconds");
    if (!figures.missing.empty()) warn(figures.missing + " The rest of the page is complete.");
    const auto wide = [](const std::string& figure) {
        return figure.empty() ? "" : "<div class=\"wide\">" + figure + "</div>\n";
    };
    std::string body =
        "<h1>" + std::string(boards.size() > 1 ? "Boards" : "A board") +
        "</h1>\n<dl><dt>Command</dt><dd><code>" + html_escape(command) + "</code></dd><dt>Date</dt><dd>" +
        date_words() + "</dd></dl>\n" + boards_html(boards) +
        (figures.missing.empty() ? "" : "<p class=\"bad\">" + html_escape(figures.missing) + "</p>\n") +
        wide(speeds);
    for (const BoardPart part : all_board_parts) {
        if (part == BoardPart::error && !plots.empty())
            body += "<h2>" + title_of(part) + "</h2>\n<div class=\"plots\">\n" + plots + "</div>\n";
        body += part_html(boards, part);
    }
    body += wide(efficiency) + left_out_html(boards) +
            (boards.size() > 1 ? "<p class=\"soft\">(xN): N times as fast as A.</p>\n" : "") +
            "<p class=\"soft\">Errors are those of paths alone, without photons, to references of 8192 "
            "samples per pixel "
            "that come with the program. The roof is the least time that reading a kernel's bytes, doing its "
            "operations or waiting for its reads would take with all data in the nearest cache.</p>\n";
    return html_page("Triad on a board", "", body);
}

}  // namespace triad
