#include "report/error_report.h"

#include <algorithm>
#include <cstdio>

#include "base/files.h"
#include "base/log.h"
#include "base/machine.h"
#include "page/html.h"
#include "report/error_pictures.h"
#include "report/error_plots.h"
#include "report/error_words.h"
#include "report/report.h"

namespace triad {
namespace {

std::string tone_class(VerdictWords::Tone tone) {
    return tone == VerdictWords::Tone::good  ? " class=\"v good\""
           : tone == VerdictWords::Tone::bad ? " class=\"v bad\""
                                             : " class=\"v\"";
}

std::string digits_html(double value) { return html_escape(digits3(value)); }

std::string count(double value) { return html_escape(count_words(value)); }

std::string hundredths(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

/// A cell with its column's name, which a phone shows beside it.
std::string cell(const char* label, const std::string& html, const std::string& below = "") {
    return std::string("<td class=\"n\" data-label=\"") + label + "\"><span class=\"v\">" + html + "</span>" +
           (below.empty() ? "" : "<small>" + below + "</small>") + "</td>";
}

std::string words_cell(const char* label, const VerdictWords& verdict) {
    return std::string("<td data-label=\"") + label + "\"><span" + tone_class(verdict.tone) + ">" +
           html_escape(verdict.words) + "</span></td>";
}

std::string figure(const std::string& source, const std::string& words, const std::string& caption,
                   const std::string& more = "", const char* place = "") {
    return std::string("<figure") + place + "><img src=\"" + source + "\" alt=\"" + html_escape(words) +
           "\">" + more + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string legend(const ColourScale& scale, const std::string& low, const std::string& high) {
    return "<div class=\"scale\"><span>" + low + "</span><i style=\"background:" + css_gradient(scale) +
           "\"></i><span>" + high + "</span></div>";
}

const ErrorCurve& first_of(const ErrorBench& bench, const std::string& scene) {
    return *std::find_if(bench.curves.begin(), bench.curves.end(),
                         [&](const ErrorCurve& c) { return c.scene == scene; });
}

std::string head_html(const ErrorBench& bench, const ErrorReportHead& head) {
    std::string html = "<h1>" + html_escape(head.title) + "</h1>\n";
    for (const SettingScore& score : head.scores) {
        const std::string of = bench.settings.size() > 1 ? " of " + html_escape(score.setting) : "";
        html += "<p class=\"score\">Score" + of + ": ";
        if (score.score)
            html += "<b>" + digits_html(score.score->value) + "</b> <span class=\"soft\">(95 % interval " +
                    html_escape(interval_words(*score.score)) +
                    "; 100 is the published baseline)</span></p>\n";
        else
            html += std::string("<b class=\"bad\">") + (score.is_void ? "void" : "none") + "</b> <span>" +
                    html_escape(score.why_none) + "</span></p>\n";
    }
    if (bench.interrupted)
        html += "<p class=\"bad\">The run was stopped early: this is what it had measured until then.</p>\n";
    html += "<dl>";
    auto item = [&](const char* name, const std::string& text) {
        if (!text.empty()) html += std::string("<dt>") + name + "</dt><dd>" + html_escape(text) + "</dd>";
    };
    item("Date", head.date);
    item("Command", head.command);
    item("Machine", machine_words());
    item("Version", TRIAD_VERSION);
    item("Repetitions", std::to_string(bench.repetitions) + ", each with a seed of its own");
    for (const ErrorSetting& setting : bench.settings)
        item("Setting", setting.name + (setting.options.empty() ? "" : ": " + setting.options) + ", on " +
                            setting.device + ", driver " + setting.driver);
    return html + "</dl>\n";
}

std::string summary_html(const ErrorBench& bench) {
    std::string html =
        "<h2>Summary</h2>\n<table><thead><tr><th>Scene</th><th>Setting</th><th>Samples per "
        "pixel</th><th>Time (s)</th>"
        "<th>relMSE</th><th>relMSE, 0.1 % trimmed</th><th>FLIP</th><th>Fireflies "
        "(pixels)</th><th>Slope</th><th>Verdict</th></tr></thead>"
        "<tbody>\n";
    for (const ErrorCurve& curve : bench.curves) {
        if (curve.points.empty()) continue;
        const ErrorPoint& last = curve.points.back();
        html += "<tr><th data-label=\"Scene\">" + html_escape(curve.scene) +
                "</th><td data-label=\"Setting\"><span class=\"v\">" + html_escape(curve.setting) +
                "</span></td>" + cell("Samples per pixel", count(last.spp)) +
                cell("Time (s)", digits_html(last.seconds)) +
                cell("relMSE", digits_html(last.relmse.value), html_escape(interval_words(last.relmse))) +
                cell("Trimmed relMSE", digits_html(last.relmse_trimmed)) +
                cell("FLIP", digits_html(last.flip)) +
                cell("Fireflies", count(last.fireflies),
                     last.nan ? html_escape(std::to_string(last.nan) + " samples not finite") : "") +
                (curve.slope ? cell("Slope", hundredths(curve.slope->value),
                                    hundredths(curve.slope->low) + " to " + hundredths(curve.slope->high))
                             : cell("Slope", "not known")) +
                words_cell("Verdict", verdict_of(curve, first_of(bench, curve.scene))) + "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

constexpr char how_to_read[] =
    "<details><summary>How to read this</summary>\n"
    "<p>Numbers are medians over the repetitions at the last sample count; the range below one is its "
    "95 % interval. "
    "<b>relMSE</b> is the mean over pixels and channels of (x - r)<sup>2</sup> / (r<sup>2</sup> + 0.01), "
    "with the picture x and the reference r; "
    "the reference's own noise is subtracted, so a value near it may even be negative. <b>Trimmed</b>: "
    "without the 0.1 % worst pixels. "
    "<b>FLIP</b> is what an observer would notice when flipping between the two pictures, 0 to 1. "
    "<b>Fireflies</b> are pixels "
    "more than 20 times as bright as the reference. <b>Slope</b>: how the relative error (the square root of "
    "relMSE) falls with samples, "
    "-0.5 for independent samples, steeper is better. <b>Time</b> is rendering alone: no loading, compiling "
    "or measuring.</p>\n"
    "<p>A verdict <b>void</b> means that the mean of all pictures differs from the reference by more than "
    "noise: "
    "then speed means nothing.</p></details>\n";

std::string changes_html(const ErrorBench& bench) {
    if (bench.changes.empty()) return "";
    std::string html =
        "<h2>Against the earlier run</h2>\n<table><thead><tr><th>Scene</th><th>Setting</th><th>Time to equal "
        "error, new / old</th>"
        "<th>relMSE at equal samples, new / old</th><th>p</th><th>Verdict</th></tr></thead><tbody>\n";
    for (const ErrorChange& change : bench.changes)
        html += "<tr><th data-label=\"Scene\">" + html_escape(change.scene) +
                "</th><td data-label=\"Setting\"><span class=\"v\">" + html_escape(change.setting) +
                "</span></td>" +
                cell("Time, new / old", digits_html(change.time_ratio.value),
                     html_escape(interval_words(change.time_ratio))) +
                (change.error_ratio ? cell("relMSE, new / old", digits_html(change.error_ratio->value),
                                           html_escape(interval_words(*change.error_ratio)))
                                    : cell("relMSE, new / old", "-", "no samples in common")) +
                cell("p", digits_html(change.p)) + words_cell("Verdict", verdict_of(change)) + "</tr>\n";
    return html + "</tbody></table>\n";
}

std::string plot_html(const ErrorPlots& plots, const std::string& scene) {
    std::string html;
    for (const ErrorPlot& plot : plots.plots)
        if (plot.scene == scene)
            html += figure(data_uri("image/svg+xml", {reinterpret_cast<const std::uint8_t*>(plot.svg.data()),
                                                      plot.svg.size()}),
                           plot.words, html_escape(plot.words) + " (" + html_escape(plot.file) + ")");
    return html;
}

std::string scene_html(const ErrorBench& bench, const ErrorScene& scene, const ErrorPlots& plots) {
    std::string html =
        "<h2>" + html_escape(scene.name) + "</h2>\n<p class=\"soft\">" +
        (scene.options.empty() ? "The built-in scene" : "<code>" + html_escape(scene.options) + "</code>") +
        ", " + std::to_string(scene.reference.width) + " x " + std::to_string(scene.reference.height) +
        " pixels. The reference has " + count(scene.reference_spp) +
        " samples per pixel; its own relMSE is " + digits_html(scene.reference_relmse) + ", and it " +
        (scene.reference_seconds > 0 ? "took " + digits_html(scene.reference_seconds) + " s of this run."
                                     : "was kept from before.") +
        "</p>\n";
    const std::string scene_plots = plot_html(plots, scene.name);
    if (!scene_plots.empty()) html += "<div class=\"plots\">\n" + scene_plots + "</div>\n";
    html +=
        "<div class=\"pictures\">\n" +
        figure(data_uri("image/png", png_of(scene.reference_display)), "Reference picture of " + scene.name,
               "<b>Reference</b>, " + count(scene.reference_spp) + " samples per pixel");
    std::vector<const std::vector<float>*> maps;
    for (const ErrorCurve& curve : bench.curves)
        if (curve.scene == scene.name) maps.push_back(&curve.rel_error);
    const double limit = round_limit(maps);
    const unsigned width = scene.reference.width, height = scene.reference.height;
    for (const ErrorCurve& curve : bench.curves) {
        if (curve.scene != scene.name || curve.points.empty()) continue;
        const std::string name = html_escape(curve.setting);
        const ErrorPoint& last = curve.points.back();
        // Beside the reference, or below its first picture.
        const bool first = &curve == &first_of(bench, scene.name);
        html += figure(data_uri("image/png", png_of(curve.display)),
                       "Picture of " + scene.name + " with " + curve.setting,
                       "<b>" + name + "</b>, " + count(last.spp) + " samples per pixel in " +
                           digits_html(last.seconds) + " s",
                       "", first ? "" : " class=\"first\"");
        if (!curve.rel_error.empty()) {
            const ColourScale scale{-limit, limit, true};
            html += figure(
                data_uri("image/png", false_colour_png(curve.rel_error, width, height, scale)),
                "Relative error of " + curve.setting + ", pixel by pixel",
                "<b>" + name + "</b>, relative error, pixel by pixel",
                legend(scale, "too dark, -" + digits_html(limit), "+" + digits_html(limit) + ", too bright"));
        }
        if (!curve.flip_map.empty()) {
            const ColourScale scale{0, 1, false};
            html += figure(data_uri("image/png", false_colour_png(curve.flip_map, width, height, scale)),
                           "FLIP map of " + curve.setting,
                           "<b>" + name + "</b>, FLIP, mean " + digits_html(last.flip),
                           legend(scale, "the same, 0", "1, quite different"));
        }
    }
    return html + "</div>\n";
}

}  // namespace

std::vector<std::filesystem::path> write_error_report(const std::filesystem::path& folder,
                                                      const ErrorBench& bench, const ErrorReportHead& head) {
    std::vector<std::filesystem::path> written;
    const ErrorPlots plots = draw_error_plots(bench);
    for (const ErrorPlot& plot : plots.plots) write_file(written.emplace_back(folder / plot.file), plot.svg);
    if (!plots.missing.empty()) warn(plots.missing + " The rest of the report is complete.");

    std::string html = head_html(bench, head) + summary_html(bench) + how_to_read + changes_html(bench);
    if (!plots.missing.empty()) html += "<p class=\"bad\">" + html_escape(plots.missing) + "</p>\n";
    const std::string efficiency = plot_html(plots, "");
    if (!efficiency.empty()) html += "<h2>Efficiency</h2>\n<div class=\"wide\">" + efficiency + "</div>\n";
    for (const ErrorScene& scene : bench.scenes) html += scene_html(bench, scene, plots);
    write_file(written.emplace_back(folder / "report.html"), html_page(head.title, "", html));
    return written;
}

}  // namespace triad
