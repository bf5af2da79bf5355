// The subpixel bench's page and its plots.
#include <algorithm>
#include <map>

#include "base/child_process.h"
#include "base/files.h"
#include "base/log.h"
#include "base/machine.h"
#include "base/text.h"
#include "report/error_plots.h"
#include "report/error_report_style.h"
#include "report/html.h"
#include "report/subpixel_report.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* eyes[] = {"scielab", "sharp", "flip"};

/// Methods in the order of a plot's key: ssaa:3, ssaa:4 ... are points of one line.
std::string family(const std::string& method) { return method.starts_with("ssaa:") ? "ssaa:N" : method; }

/// Three eyes' errors and the time, against rays; one key for all.
std::string plot_script(std::vector<SubpixelRow> rows, const std::string& title) {
    std::sort(rows.begin(), rows.end(),
              [](const SubpixelRow& a, const SubpixelRow& b) { return a.rays_per_pixel < b.rays_per_pixel; });
    std::vector<std::string> families;
    for (const SubpixelRow& row : rows)
        if (std::find(families.begin(), families.end(), family(row.method)) == families.end())
            families.push_back(family(row.method));
    std::string data;
    for (std::size_t f = 0; f < families.size(); ++f)
        for (unsigned e = 0; e < 3; ++e) {
            data += format("$f%zu_%u << EOD\n", f, e);
            for (const SubpixelRow& row : rows)
                if (family(row.method) == families[f] && row.eye == eyes[e])
                    data += format("%.6g %.6g %.6g\n", row.rays_per_pixel, row.error.value,
                                   std::max(row.seconds, 1e-6));
            data += "EOD\n";
        }
    std::string script =
        "set terminal svg size 1400,900 dynamic font 'sans-serif,13' noenhanced background '#ffffff'\n"
        "set encoding utf8\nset logscale xy\nset format xy '%g'\nset grid lc rgb '#888888' lw 0.5 dt 1\n" +
        data + "set multiplot layout 2,2 margins 0.06,0.68,0.07,0.9 spacing 0.09,0.13 title " +
        gnuplot_quoted(title) + "\n";
    for (unsigned panel = 0; panel < 4; ++panel) {
        const bool time = panel == 3;
        script += std::string("set xlabel 'rays per pixel'\nset ylabel '") +
                  (time ? "seconds" : "perceived error") + "'\nset title '" + (time ? "time" : eyes[panel]) +
                  "'\n" + (panel == 1 ? "set key at screen 0.99,0.9 right font ',11'\n" : "unset key\n") +
                  "plot ";
        for (std::size_t f = 0; f < families.size(); ++f) {
            const bool own = families[f] == subpixel_yardstick;
            script += format("$f%zu_%u using 1:%d with linespoints lw %g dt %zu pt %zu ps 0.6 ", f,
                             time ? 0 : panel, time ? 3 : 2, own ? 4.0 : 1.4,
                             own ? std::size_t(1) : 1 + f % 5, 1 + f % 13) +
                      (own ? "lc rgb 'black' " : format("lc %zu ", f)) + "title " +
                      gnuplot_quoted(families[f]) + (f + 1 < families.size() ? ", " : "\n");
        }
    }
    return script + "unset multiplot\n";
}

std::string drawn(const std::string& script) {
    const TemporaryFolder folder;
    write_file(folder.path() / "plot.gp", script);
    const auto status = run_program({"gnuplot", (folder.path() / "plot.gp").string()},
                                    folder.path() / "plot.svg", folder.path() / "log");
    if (status != 0) return "";
    const auto bytes = read_file(folder.path() / "plot.svg");
    return {bytes.begin(), bytes.end()};
}

std::string cell(const SubpixelRow& row) {
    const char* tone = row.method == subpixel_yardstick            ? ""
                       : beats_triad(row)                          ? " class=\"bad\""
                       : row.over_triad && row.over_triad->low > 0 ? " class=\"good\""
                                                                   : "";
    return format("<td class=\"n\" data-label=\"%s\"><span%s>%.3g</span><small>%.3g to %.3g</small></td>",
                  row.eye.c_str(), tone, row.error.value, row.error.low, row.error.high);
}

std::string table(const std::vector<SubpixelRow>& all, unsigned rays) {
    std::string html = format(
        "<h3>%u rays per "
        "pixel</h3>\n<table><thead><tr><th>method</th><th>rays</th><th>S-CIELAB</th><th>sharp</"
        "th><th>FLIP's</th>"
        "<th>seconds</th></tr></thead><tbody>\n",
        rays);
    std::map<std::string, std::vector<const SubpixelRow*>> by_method;
    std::vector<std::string> order;
    for (const SubpixelRow& row : all) {
        if (row.rays != rays) continue;
        if (by_method[row.method].empty()) order.push_back(row.method);
        by_method[row.method].push_back(&row);
    }
    std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
        return by_method[a][0]->error.value < by_method[b][0]->error.value;
    });
    for (const std::string& method : order) {
        const auto& rows = by_method[method];
        html += "<tr><th data-label=\"method\">" + html_escape(method) +
                format("</th><td class=\"n\" data-label=\"rays\">%g</td>", rows[0]->rays_per_pixel);
        for (const SubpixelRow* row : rows) html += cell(*row);
        html += format("<td class=\"n\" data-label=\"seconds\">%.3g</td></tr>\n", rows[0]->seconds);
    }
    return html + "</tbody></table>\n";
}

std::string display_words(const PanelView& view) {
    return view.panel.name + format(", %g pixels per degree", view.ppd);
}

std::vector<SubpixelRow> rows_on(const SubpixelReport& report, const PanelView& view) {
    std::vector<SubpixelRow> rows;
    std::copy_if(report.rows.begin(), report.rows.end(), std::back_inserter(rows),
                 [&](const SubpixelRow& row) { return is_of(row, view); });
    return rows;
}

/// Comparisons with triad on every display, and those that it has lost.
std::string verdict_table(const SubpixelReport& report) {
    std::string html =
        "<h2>Verdict</h2>\n<table><thead><tr><th>display</th><th>comparisons at equal "
        "rays</th><th>significantly better than triad</th><th>significantly worse</th></tr></thead><tbody>\n";
    for (const PanelView& view : report.plan.displays) {
        const Verdict v = verdict_of(rows_on(report, view));
        html += "<tr><th data-label=\"display\">" + html_escape(display_words(view)) +
                format(
                    "</th><td class=\"n\" data-label=\"comparisons\">%zu</td><td class=\"n\" "
                    "data-label=\"better\">%zu</td><td class=\"n\" data-label=\"worse\">%zu</td></tr>\n",
                    v.comparisons, v.better.size(), v.worse);
    }
    html += "</tbody></table>\n";
    const Verdict all = verdict_of(report.rows);
    if (all.better.empty()) return html;
    html +=
        "<h3>Better than triad</h3>\n<table><thead><tr><th>display</th><th>scene</th><th>eye</"
        "th><th>rays</th><th>method</th><th>by</th></tr></thead><tbody>\n";
    for (const SubpixelRow& row : all.better)
        html += "<tr><th data-label=\"display\">" + html_escape(row.panel) +
                format(", %g ppd</th><td data-label=\"scene\">", row.ppd) + html_escape(row.scene) +
                format(
                    "</td><td data-label=\"eye\">%s</td><td class=\"n\" data-label=\"rays\">%g</td><td "
                    "data-label=\"method\">%s</td><td class=\"n\" data-label=\"by\">%.3g<small>%.3g to "
                    "%.3g</small></td></tr>\n",
                    row.eye.c_str(), row.rays_per_pixel, row.method.c_str(), -row.over_triad->value,
                    -row.over_triad->high, -row.over_triad->low);
    return html + "</tbody></table>\n";
}

}  // namespace

void write_subpixel_report(const fs::path& folder, const SubpixelReport& report) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Subpixel reconstruction</title><style>";
    html += error_report_style;
    html +=
        "</style></head><body><h1>Subpixel reconstruction: every method against "
        "triad</h1>\n<dl><dt>Date</dt><dd>" +
        html_escape(report.date) + "</dd><dt>Command</dt><dd><code>" + html_escape(report.command) +
        "</code></dd><dt>Machine</dt><dd>" + html_escape(machine_words()) +
        "</dd></dl>\n<p>Perceived error in units of about one CIELAB unit at mid grey, lower is better, with "
        "the 95 % interval of a bootstrap over tiles. Green: triad is significantly better at equal rays "
        "(tiles drawn in pairs); red: it is "
        "significantly worse. Seconds of rays that methods share count for each of them.</p>\n" +
        verdict_table(report);
    bool missing = false;
    for (const PanelView& view : report.plan.displays) {
        const std::vector<SubpixelRow> on_display = rows_on(report, view);
        const bool first = &view == &report.plan.displays.front();
        html += std::string("<details") + (first ? " open" : "") + "><summary>" +
                html_escape(display_words(view)) + "</summary>\n";
        for (const std::string& scene : scenes_of(on_display)) {
            std::vector<SubpixelRow> rows;
            std::copy_if(on_display.begin(), on_display.end(), std::back_inserter(rows),
                         [&](const SubpixelRow& row) { return row.scene == scene; });
            html += "<h2>" + html_escape(scene) + "</h2>\n";
            // Plots of every display would make the page too large to open.
            const std::string svg = missing || !first ? "" : drawn(plot_script(rows, scene));
            missing = missing || (first && svg.empty());
            if (!svg.empty()) {
                write_file(folder / (scene + ".svg"), svg);
                html += "<figure><img alt=\"Errors and time against rays, " + html_escape(scene) +
                        "\" src=\"" +
                        data_uri("image/svg+xml",
                                 {reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}) +
                        "\"></figure>\n";
            }
            for (const unsigned rays : report.plan.rays) html += table(rows, rays);
        }
        html += "</details>\n";
    }
    if (missing) {
        warn("There are no plots: gnuplot (package gnuplot-nox) is not there, or failed.");
        html += "<p class=\"bad\">There are no plots: gnuplot is not there, or failed.</p>\n";
    }
    write_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace triad
