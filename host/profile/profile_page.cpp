#include "profile/profile_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/log.h"
#include "base/machine.h"
#include "base/text.h"
#include "kernels/types.h"
#include "page/gnuplot.h"
#include "page/html.h"
#include "profile/profile_line.h"
#include "profile/profile_report.h"

namespace triad {
namespace {

constexpr const char* style = R"css(
.bar { position: relative; background: var(--card); border-radius: .2rem; height: 1.1rem; min-width: 5rem; }
.bar i { position: absolute; inset: 0 auto 0 0; background: var(--good); opacity: .55; border-radius: .2rem; }
.line { overflow-x: auto; } .line svg { width: 100%; min-width: 40rem; height: auto; }
svg text { fill: var(--ink); font: 12px system-ui, sans-serif; }
svg .k0 { fill: #0072b2; } svg .k1 { fill: #d55e00; } svg .k2 { fill: #009e73; } svg .k3 { fill: #cc79a7; }
svg .k4 { fill: #e69f00; } svg .k5 { fill: #56b4e9; } svg .k6 { fill: #888; }
)css";

std::string number_or_dash(double v, const char* pattern) { return v > 0 ? format(pattern, v) : "-"; }

std::string kernels_html(const Profile& p) {
    std::string html =
        "<table><thead><tr><th>Kernel</th><th>Share</th><th>ms of a run</th><th>Launches</th><th>Median, p95 "
        "ms</th><th>M items/s</th><th>GB/s</th><th>GFLOP/s</th><th>Of the roof</th></tr></thead><tbody>\n";
    for (const KernelRow& r : p.rows) {
        html += "<tr><th data-label=\"Kernel\">" + html_escape(r.kernel) + "</th>";
        html += "<td data-label=\"Share\"><div class=\"v\"><div class=\"bar\"><i style=\"width:" +
                format("%.1f", 100 * r.share) + "%\"></i></div>" + format("%.1f %%", 100 * r.share) +
                "</div></td>";
        html += number_cell("ms of a run", format("%.1f (%.1f to %.1f)", r.ms.value, r.ms.low, r.ms.high));
        html += number_cell("Launches", format("%.0f", double(r.launches) / p.runs));
        html += number_cell("Median, p95 ms", format("%.3f, %.3f", r.ms_median, r.ms_p95));
        html += number_cell("M items/s", number_or_dash(1e-6 * r.items_per_s, "%.2f"));
        html += number_cell("GB/s", number_or_dash(1e-9 * r.bytes_per_s(), "%.2f"));
        html += number_cell("GFLOP/s", number_or_dash(1e-9 * r.flops_per_s(), "%.2f"));
        html += number_cell("Of the roof",
                            r.floor ? format("%.0f %% of ", 100 * *r.roofline_share()) + r.floor->by : "-");
        html += "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

std::string rays_html(const WorkCounts& c) {
    std::string html =
        "<table><thead><tr><th>Rays</th><th>Per sample</th><th>Nodes</th><th>Leaves</th><th>Triangles</th>"
        "<th>Stack, deepest</th></tr></thead><tbody>\n";
    const double samples = double(c.width) * c.height * c.samples;
    for (unsigned kind = 0; kind < WORK_KINDS; ++kind) {
        const RayCounts& r = c.rays[kind];
        const double n = double(std::max<std::uint64_t>(1, r.rays));
        html += std::string("<tr><th data-label=\"Rays\">") + ray_kind(kind) + "</th>" +
                number_cell("Per sample", format("%.3f", double(r.rays) / samples)) +
                number_cell("Nodes", format("%.2f", double(r.nodes) / n)) +
                number_cell("Leaves", format("%.2f", double(r.blocks) / n)) +
                number_cell("Triangles", format("%.2f", double(r.triangles) / n)) +
                number_cell("Stack, deepest", format("%.2f, %u", double(r.deepest_sum) / n, r.deepest)) +
                "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

std::string edges_html(const WorkCounts& c) {
    std::string html =
        "<table><thead><tr><th>Edge</th><th>Rays per sample</th><th>That hit</th><th>Shadow "
        "rays</th></tr></thead><tbody>\n";
    for (const EdgeLine& e : edge_lines(c))
        html += "<tr><th data-label=\"Edge\">" + html_escape(e.name) + "</th>" +
                number_cell("Rays per sample", format("%.4f", e.rays)) +
                number_cell("That hit", format("%.4f", e.hits)) +
                number_cell("Shadow rays", format("%.4f", e.shadow_rays)) + "</tr>\n";
    return html + "</tbody></table>\n";
}

std::string peaks_html(const Profile& p) {
    std::string html =
        "<table><thead><tr><th>Data in</th><th>Read GB/s</th><th>Copy GB/s</th><th>M dependent "
        "reads/s</th></tr></thead><tbody>\n";
    for (const MemoryPeak& m : p.peaks.memory)
        html += "<tr><th data-label=\"Data in\">" + bytes_text(m.bytes) + "</th>" +
                number_cell("Read GB/s", format("%.1f", 1e-9 * m.read)) +
                number_cell("Copy GB/s", format("%.1f", 1e-9 * m.copy)) +
                number_cell("M dependent reads/s", format("%.1f", 1e-6 * m.gathers)) + "</tr>\n";
    return html + "</tbody></table>\n";
}

std::string rest_html(const Profile& p) {
    std::string html = "<h3>Everything else</h3>\n<dl>";
    const auto add = [&](const std::string& name, const std::string& text) {
        html += "<dt>" + html_escape(name) + "</dt><dd>" + html_escape(text) + "</dd>\n";
    };
    add("Queue",
        format("at work for %.3f s of a run; waits %.3f s between commands, %.3f s of it for the host",
               p.busy, p.waiting, p.host_between));
    std::string memory, compiled, facts;
    for (const auto& [name, bytes] : p.memory)
        memory += (memory.empty() ? "" : ", ") + name + " " + bytes_text(bytes);
    add("On the device", memory);
    for (const Compilation& c : p.compilations)
        compiled += (compiled.empty() ? "" : ", ") + c.program + format(" %.2f s", c.seconds);
    add("Compiled or loaded", compiled);
    for (const KernelRow& r : p.rows)
        if (r.kind == CommandKind::kernel)
            facts += (facts.empty() ? "" : "; ") + r.kernel + ": " + std::to_string(r.facts.private_bytes) +
                     " bytes private, groups of " + std::to_string(r.facts.max_local) +
                     " at most, multiples of " + std::to_string(r.facts.preferred_multiple);
    add("What the driver says", facts);
    return html + "</dl>\n";
}

std::string device_html(const Profile& p, const std::vector<HostSpan>& spans, const std::string& maps,
                        std::string& missing) {
    const Estimate seconds = median_estimate(p.seconds_of_runs);
    std::string html = "<h2>" + html_escape(p.device.name) + "</h2>\n<p>" + html_escape(p.device.platform) +
                       ", driver " + html_escape(p.device.driver) + "; paths by " +
                       html_escape(p.path_driver) + ", nodes " + html_escape(p.format) + ". " +
                       format("%u runs of %.0f samples, %.3f s each (%.3f to %.3f).", p.runs, p.samples,
                              seconds.value, seconds.low, seconds.high) +
                       "</p>\n" + kernels_html(p);
    const std::string script = roofline_script(p);
    const std::string svg = script.empty() ? "" : draw_with_gnuplot(script, "the roofline", missing);
    if (!svg.empty())
        html +=
            "<div class=\"wide\"><figure><img alt=\"Roofline\" src=\"" +
            data_uri("image/svg+xml", {reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}) +
            "\"><figcaption>Operations of boxes and triangles per byte that is touched, and how fast. Lines "
            "are what the device does at most, with data in its caches and in "
            "memory.</figcaption></figure></div>\n";
    html += profile_line(p, spans);
    if (p.counts.samples == 0) return html + rest_html(p);
    return html + "<h3>What rays take</h3>\n" + rays_html(p.counts) + "<h3>How long the lists are</h3>\n" +
           edges_html(p.counts) + maps + "<h3>The roof, measured here</h3>\n" +
           format("<p>%.1f GFLOP/s of fused multiply-adds.</p>\n", 1e-9 * p.peaks.flops) + peaks_html(p) +
           rest_html(p);
}

}  // namespace

std::string roofline_script(const Profile& p) {
    std::string data, labels;
    std::size_t points = 0;
    double low = 1, high = 0;
    for (const KernelRow& r : p.rows) {
        if (!r.cost || !(r.cost->flops > 0) || !(r.cost->bytes > 0)) continue;
        const double intensity = r.cost->flops / r.cost->bytes;
        data += format("%.9g %.9g %u\n", intensity, 1e-9 * r.flops_per_s(), unsigned(points + 1));
        labels += (points ? ", " : "") + std::string("$kernels using ($3==") + std::to_string(points + 1) +
                  "?$1:1/0):2 with points pt " + std::to_string(5 + 2 * points) + " ps 1.2 lc rgb '" +
                  pen_of(points).colour + "' title " + gnuplot_quoted(r.kernel);
        low = std::min(low, 1e-9 * r.flops_per_s()), high = std::max(high, intensity);
        ++points;
    }
    if (points == 0) return "";
    const double roof = 1e-9 * p.peaks.flops;
    std::string script = plot_head("Roofline", 380 + 19.0 * double(points + p.peaks.memory.size()));
    script +=
        "set xlabel 'operations per byte'\nset ylabel 'GFLOP/s'\nset logscale xy 10\nset format xy '%g'\n"
        "set key tmargin center\nset samples 200\n";
    script += format("set xrange [0.01:%.9g]\nset yrange [%.9g:%.9g]\n", std::max(100.0, 3 * high), 0.3 * low,
                     2 * roof);
    script += "$kernels << EOD\n" + data + "EOD\nplot ";
    std::size_t dash = 1;
    for (const MemoryPeak& m : p.peaks.memory)
        script +=
            format("(x * %.9g < %.9g ? x * %.9g : %.9g) with lines lw 1.5 dt %u lc rgb '#888888' title ",
                   1e-9 * m.read, roof, 1e-9 * m.read, roof, unsigned(dash++)) +
            gnuplot_quoted("roof, data in " + bytes_text(m.bytes)) + ", ";
    return script + labels + "\n";
}

std::string profile_page(const std::vector<Profile>& profiles, const std::vector<HostSpan>& spans,
                         const std::string& command, const ProfileMaps& maps) {
    std::string missing, devices;
    for (const Profile& p : profiles)
        devices += device_html(p, spans, maps.html ? maps.html(p) : "", missing);
    if (!missing.empty()) warn(missing + " The rest of the page is complete.");
    return html_page(
        "Triad profile", style + maps.css,
        std::string("<h1>Where the time goes</h1>\n<dl><dt>Command</dt><dd><code>") + html_escape(command) +
            "</code></dd><dt>Date</dt><dd>" + date_words() + "</dd><dt>Machine</dt><dd>" +
            html_escape(machine_words()) + "</dd><dt>Triad</dt><dd>" TRIAD_VERSION "</dd></dl>\n" +
            (missing.empty() ? "" : "<p class=\"bad\">" + html_escape(missing) + "</p>\n") + devices +
            "<p class=\"soft\">Visits are counted by an instrumented program on other samples of the "
            "picture; "
            "bytes, operations (of boxes and triangles alone, not of shading) and dependent reads follow by "
            "formula. "
            "The roof is the least time that reading these bytes, doing these operations or waiting for "
            "these "
            "reads would take with all data in the nearest cache.</p>\n");
}

}  // namespace triad
