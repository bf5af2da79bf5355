// The subpixel bench's page and its plots.
#include <algorithm>
#include <map>

#include "base/files.h"
#include "base/machine.h"
#include "base/text.h"
#include "page/html.h"
#include "page/page_style.h"
#include "report/subpixel_plots.h"
#include "report/subpixel_report.h"
#include "report/subpixel_sights.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

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

/// By S-CIELAB's eye: methods by error for each number of rays, and error for time. Also as FOLDER/SCENE.svg.
std::string plots(const fs::path& folder, const std::string& scene, const std::vector<SubpixelRow>& all,
                  const std::vector<unsigned>& numbers) {
    std::vector<SubpixelRow> rows;
    std::copy_if(all.begin(), all.end(), std::back_inserter(rows),
                 [](const SubpixelRow& row) { return row.eye == "scielab"; });
    const auto letters = method_letters(rows);
    std::string html = "<div class=\"plots\">\n";
    const auto add = [&](const std::string& svg, const std::string& caption) {
        html += "<figure>" + svg + "<figcaption>" + html_escape(caption) + "</figcaption></figure>\n";
    };
    for (const unsigned rays : numbers) {
        std::vector<SubpixelRow> of_rays;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(of_rays),
                     [rays](const SubpixelRow& row) { return row.rays == rays; });
        add(ranked_dots(of_rays, letters), format("%u rays per pixel", rays));
    }
    const std::string time = error_for_time(rows, letters);
    add(time, "Error for time; the line joins what nothing beats in both");
    write_file(folder / (scene + ".svg"), time);
    return html + "</div>\n";
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
        const SubpixelVerdict v = verdict_of(rows_on(report, view));
        html += "<tr><th data-label=\"display\">" + html_escape(display_words(view)) +
                format(
                    "</th><td class=\"n\" data-label=\"comparisons\">%zu</td><td class=\"n\" "
                    "data-label=\"better\">%zu</td><td class=\"n\" data-label=\"worse\">%zu</td></tr>\n",
                    v.comparisons, v.better.size(), v.worse);
    }
    html += "</tbody></table>\n";
    const SubpixelVerdict all = verdict_of(report.rows);
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
    html += page_style;
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
            for (const SubpixelSight& sight : report.sights)
                if (first && sight.scene == scene) html += sights_of(sight, view);
            html += first ? plots(folder, scene, rows, report.plan.rays) : "";
            for (const unsigned rays : report.plan.rays) html += table(rows, rays);
        }
        html += "</details>\n";
    }
    write_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace triad
