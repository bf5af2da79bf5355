#include "app/subpixel_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/child_process.h"
#include "app/error_plots.h"
#include "app/error_report_style.h"
#include "app/html.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* eyes[] = {"scielab", "sharp", "flip"};

/// Methods in the order of a plot's key: ssaa:3, ssaa:4 ... are points of one line.
std::string family(const std::string& method) { return method.starts_with("ssaa:") ? "ssaa:N" : method; }

std::vector<std::string> in_order(const std::vector<SubpixelRow>& rows, auto&& member) {
    std::vector<std::string> names;
    for (const SubpixelRow& row : rows)
        if (std::find(names.begin(), names.end(), member(row)) == names.end()) names.push_back(member(row));
    return names;
}

std::vector<std::string> scenes_of(const SubpixelReport& r) {
    return in_order(r.rows, [](const SubpixelRow& row) { return row.scene; });
}

/// Three eyes' errors and the time, against rays; one key for all.
std::string plot_script(const SubpixelReport& report, const std::string& scene) {
    std::vector<SubpixelRow> rows;
    for (const SubpixelRow& row : report.rows)
        if (row.scene == scene) rows.push_back(row);
    std::sort(rows.begin(), rows.end(),
              [](const SubpixelRow& a, const SubpixelRow& b) { return a.rays_per_pixel < b.rays_per_pixel; });
    const std::vector<std::string> families =
        in_order(rows, [](const SubpixelRow& row) { return family(row.method); });
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
        gnuplot_quoted(scene) + "\n";
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

std::string table(const SubpixelReport& report, const std::string& scene, unsigned rays) {
    std::string html = format(
        "<h3>%u rays per "
        "pixel</h3>\n<table><thead><tr><th>method</th><th>rays</th><th>S-CIELAB</th><th>sharp</"
        "th><th>FLIP's</th>"
        "<th>seconds</th></tr></thead><tbody>\n",
        rays);
    std::map<std::string, std::vector<const SubpixelRow*>> by_method;
    std::vector<std::string> order;
    for (const SubpixelRow& row : report.rows) {
        if (row.scene != scene || row.rays != rays) continue;
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

}  // namespace

Json rows_of(const SubpixelReport& report) {
    Json rows = Json::array();
    for (const SubpixelRow& row : report.rows) {
        rows.push_back({{"scene", row.scene},
                        {"panel", report.plan.panel.name},
                        {"ppd", report.plan.ppd},
                        {"eye", row.eye},
                        {"method", row.method},
                        {"rays_per_pixel", row.rays_per_pixel},
                        {"error", row.error.value},
                        {"error_low", row.error.low},
                        {"error_high", row.error.high},
                        {"seconds", row.seconds},
                        {"lightness", row.lightness},
                        {"colour", row.colour}});
        if (row.over_triad)
            rows.back()["over_triad"] = {row.over_triad->value, row.over_triad->low, row.over_triad->high};
    }
    return rows;
}

std::string csv_of(const SubpixelReport& report) {
    std::string csv =
        "scene,panel,ppd,eye,method,rays_per_pixel,error,error_low,error_high,seconds,lightness,colour,over_"
        "triad,over_triad_low,over_triad_high\n";
    const auto quoted = [](const std::string& text) {
        std::string out = "\"";
        for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
        return out + "\"";
    };
    for (const SubpixelRow& r : report.rows) {
        csv += quoted(r.scene) + "," + quoted(report.plan.panel.name) +
               format(",%g,%s,%s,%g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,", report.plan.ppd, r.eye.c_str(),
                      r.method.c_str(), r.rays_per_pixel, r.error.value, r.error.low, r.error.high, r.seconds,
                      r.lightness, r.colour);
        csv += r.over_triad
                   ? format("%.6g,%.6g,%.6g\n", r.over_triad->value, r.over_triad->low, r.over_triad->high)
                   : ",,\n";
    }
    return csv;
}

std::string summary_of(const SubpixelReport& report) {
    std::string text;
    for (const std::string& scene : scenes_of(report))
        for (const unsigned rays : report.plan.rays) {
            std::vector<const SubpixelRow*> rows;
            for (const SubpixelRow& row : report.rows)
                if (row.scene == scene && row.rays == rays && row.eye == eyes[0]) rows.push_back(&row);
            std::sort(rows.begin(), rows.end(),
                      [](auto* a, auto* b) { return a->error.value < b->error.value; });
            text += format("%s, %u rays:", scene.c_str(), rays);
            for (const SubpixelRow* row : rows)
                text += format(" %s %.3g", row->method.c_str(), row->error.value);
            text += "\n";
        }
    std::size_t better = 0, all = 0;
    for (const SubpixelRow& row : report.rows) {
        if (!row.over_triad || row.method == subpixel_adaptive) continue;
        ++all;
        if (!beats_triad(row)) continue;
        ++better;
        text += format("better than triad: %s, %s, %s, %g rays: by %.3g (%.3g to %.3g)\n", row.scene.c_str(),
                       row.eye.c_str(), row.method.c_str(), row.rays_per_pixel, -row.over_triad->value,
                       -row.over_triad->high, -row.over_triad->low);
    }
    return text +
           format("%zu of %zu comparisons at equal rays are significantly better than triad\n", better, all);
}

void write_subpixel_report(const fs::path& folder, const SubpixelReport& report) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Subpixel reconstruction</title><style>";
    html += error_report_style;
    html +=
        "</style></head><body><h1>Subpixel reconstruction: every method against "
        "triad</h1>\n<dl><dt>Date</dt><dd>" +
        html_escape(report.date) + "</dd><dt>Command</dt><dd><code>" + html_escape(report.command) +
        "</code></dd><dt>Panel</dt><dd>" + html_escape(report.plan.panel.name) +
        format(", %g pixels per degree", report.plan.ppd) + "</dd><dt>Machine</dt><dd>" +
        html_escape(machine_words()) +
        "</dd></dl>\n<p>Perceived error in units of about one CIELAB unit at mid grey, lower is better, with "
        "the 95 % interval of a bootstrap over tiles. Green: triad is significantly better at equal rays "
        "(tiles drawn in pairs); red: it is "
        "significantly worse. Seconds of rays that methods share count for each of them.</p>\n";
    bool missing = false;
    for (const std::string& scene : scenes_of(report)) {
        html += "<h2>" + html_escape(scene) + "</h2>\n";
        const std::string svg = missing ? "" : drawn(plot_script(report, scene));
        missing = svg.empty();
        if (!svg.empty()) {
            write_file(folder / (scene + ".svg"), svg);
            html +=
                "<figure><img alt=\"Errors and time against rays, " + html_escape(scene) + "\" src=\"" +
                data_uri("image/svg+xml", {reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}) +
                "\"></figure>\n";
        }
        for (const unsigned rays : report.plan.rays) html += table(report, scene, rays);
    }
    if (missing) {
        warn("There are no plots: gnuplot (package gnuplot-nox) is not there, or failed.");
        html += "<p class=\"bad\">There are no plots: gnuplot is not there, or failed.</p>\n";
    }
    write_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace triad
