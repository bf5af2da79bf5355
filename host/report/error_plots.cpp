#include "report/error_plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/text.h"
#include "page/gnuplot.h"

namespace triad {
namespace {

constexpr int markers[] = {7, 5, 9, 11, 13, 6, 4};

std::string line_style(std::size_t setting) {
    return format("lc rgb '%s' lw 2 dt %u pt %d ps 0.8", pen_of(setting).colour,
                  1 + unsigned(setting + setting / pen_count) % 5, markers[setting % std::size(markers)]);
}

struct Limits {
    double low = INFINITY, high = 0;
    void add(double v) {
        if (v > 0 && std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    bool empty() const { return !(high > 0); }
};

/// Labels at 1, 2, 5 x 10^k; over three decades at 10^k alone.
std::string ticks(const char* axis, const Limits& limits) {
    std::string list;
    const bool all = limits.high / limits.low < 1000;
    for (double decade = std::pow(10.0, std::floor(std::log10(limits.low)) - 1); decade <= limits.high * 10;
         decade *= 10)
        for (const double step : {1.0, 2.0, 5.0})
            if (all || step == 1) list += (list.empty() ? "" : ", ") + format("%.9g", step * decade);
    return std::string("set ") + axis + "tics (" + list + ")\n";
}

std::string slug(const std::string& name) {
    std::string out;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!out.empty() && out.back() != '-')
            out += '-';
    while (!out.empty() && out.back() == '-') out.pop_back();
    return out;
}

}  // namespace

std::string error_plot_script(const ErrorBench& bench, const std::string& scene, bool on_time) {
    std::vector<const ErrorCurve*> curves;
    for (const ErrorCurve& curve : bench.curves)
        if (curve.scene == scene) curves.push_back(&curve);
    // A setting looks the same in every plot, also where another has no curve.
    const auto look_of = [&](std::size_t curve) {
        const auto setting = std::ranges::find(bench.settings, curves[curve]->setting, &ErrorSetting::name);
        return setting == bench.settings.end() ? curve : std::size_t(setting - bench.settings.begin());
    };
    Limits x, y;
    std::string data;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        data += format("$curve%zu << EOD\n", i);
        for (const ErrorPoint& p : curves[i]->points) {
            if (!(p.relmse.value > 0))
                continue;  // lost in the reference's own error: no place on a logarithmic axis
            const double at = on_time ? p.seconds : p.spp;
            // An interval that reaches below 0 is drawn to a tenth of the value.
            const double low = std::max(p.relmse.low, 0.01 * p.relmse.value);
            data += format("%.9g %.9g %.9g %.9g\n", at, std::sqrt(p.relmse.value), std::sqrt(low),
                           std::sqrt(std::max(p.relmse.high, p.relmse.value)));
            x.add(at), y.add(std::sqrt(p.relmse.value)),
                y.add(std::sqrt(std::max(p.relmse.high, p.relmse.value)));
        }
        data += "EOD\n";
    }
    if (x.empty() || y.empty()) return "";
    std::string script = plot_head(scene + (on_time ? ": error against time" : ": error against samples"),
                                   360 + 19 * double(curves.size() + 1));
    script += on_time ? "set xlabel 'seconds of rendering'\n" : "set xlabel 'samples per pixel'\n";
    script +=
        "set ylabel 'relative error (square root of relMSE)'\nset key tmargin center\nset format "
        "xy "
        "'%g'\n";
    script += on_time ? "set logscale xy 10\n" : "set logscale y 10\nset logscale x 2\n";
    script += format("set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", x.low / 1.25, x.high * 1.25,
                     y.low / 1.4, y.high * 1.3);
    script += ticks("y", y) + (on_time ? ticks("x", x) : "") + data + "plot ";
    for (std::size_t i = 0; i < curves.size(); ++i)
        script += format(
            "$curve%zu using 1:3:4 with filledcurves fs transparent solid 0.18 noborder lc rgb '%s' "
            "notitle, ",
            i, pen_of(look_of(i)).colour);
    // What independent samples give: the error falls with the square root of what is spent, from the first
    // curve's beginning.
    const auto first = std::find_if(curves[0]->points.begin(), curves[0]->points.end(),
                                    [](const ErrorPoint& p) { return p.relmse.value > 0; });
    if (first != curves[0]->points.end())
        script +=
            format("%.9g * (x / %.9g)**-0.5 with lines lc rgb 'black' lw 1 dt (4,4) title 'slope -0.5', ",
                   std::sqrt(first->relmse.value), on_time ? first->seconds : first->spp);
    for (std::size_t i = 0; i < curves.size(); ++i)
        script += format("$curve%zu using 1:2 with linespoints ", i) + line_style(look_of(i)) + " title " +
                  gnuplot_quoted(curves[i]->setting) + (i + 1 < curves.size() ? ", " : "\n");
    return script;
}

std::string efficiency_plot_script(const ErrorBench& bench, const std::string& unit) {
    const std::size_t settings = bench.settings.size();
    Limits x;
    std::vector<std::string> data(settings);
    std::string ticks;
    for (std::size_t s = 0; s < bench.scenes.size(); ++s) {
        const double top = -double(s * (settings + 1));
        ticks += (ticks.empty() ? "" : ", ") + gnuplot_quoted(bench.scenes[s].name) +
                 format(" %.9g", top - 0.5 * double(settings - 1));
        for (const ErrorCurve& curve : bench.curves) {
            if (curve.scene != bench.scenes[s].name || !curve.efficiency || !(curve.efficiency->value > 0))
                continue;
            const auto which =
                std::find_if(bench.settings.begin(), bench.settings.end(),
                             [&](const ErrorSetting& setting) { return setting.name == curve.setting; });
            const auto j = static_cast<std::size_t>(which - bench.settings.begin());
            const Estimate& e = *curve.efficiency;
            data[j] += format("%.9g %.9g %.9g %.9g\n", e.value, top - double(j),
                              std::max(e.low, 0.1 * e.value), e.high);
            x.add(e.value), x.add(e.low), x.add(e.high);
        }
    }
    if (x.empty()) return "";
    const double rows = double(bench.scenes.size() * (settings + 1));
    std::string script = plot_head("Efficiency: " + unit + ", further right is better",
                                   120 + 19 * double(settings) + 24 * rows);
    script += "set xlabel " + gnuplot_quoted(unit) + "\nset logscale x 10\nset format x '%g'\n";
    script += "set key tmargin center\nset ytics (" + ticks + ") scale 0\n";
    script += format("set xrange [%.9g:%.9g]\nset yrange [%.9g:1]\nset bars 0.4\n", x.low / 1.5, x.high * 1.5,
                     -rows + 1);
    for (std::size_t j = 0; j < settings; ++j) script += format("$values%zu << EOD\n", j) + data[j] + "EOD\n";
    script += "plot ";
    for (std::size_t j = 0; j < settings; ++j) {
        if (data[j].empty()) continue;
        if (script.back() != ' ') script += ", ";
        script += format("$values%zu using 1:2:3:4 with xerrorbars lw 1.5 pt %d ps 0.8 lc rgb '%s' title ", j,
                         markers[j % std::size(markers)], pen_of(j).colour) +
                  gnuplot_quoted(bench.settings[j].name);
    }
    return script + "\n";
}

ErrorPlots draw_error_plots(const ErrorBench& bench) {
    ErrorPlots result;
    auto draw = [&](const std::string& script, ErrorPlot plot) {
        if (script.empty() || !result.missing.empty()) return;
        plot.svg = draw_with_gnuplot(script, plot.file, result.missing);
        if (!plot.svg.empty()) result.plots.push_back(std::move(plot));
    };
    for (std::size_t i = 0; i < bench.scenes.size(); ++i) {
        const std::string& name = bench.scenes[i].name;
        const std::string number = bench.scenes.size() > 1 ? format("%02zu-", i + 1) : "";
        draw(error_plot_script(bench, name, false),
             {number + slug(name) + "-samples.svg", name,
              "Relative error of " + name + " against samples per pixel, one curve per setting"});
        draw(error_plot_script(bench, name, true),
             {number + slug(name) + "-time.svg", name,
              "Relative error of " + name + " against seconds, one curve per setting"});
    }
    draw(efficiency_plot_script(bench, "1 / (MSE x seconds)"),
         {"efficiency.svg", "", "Efficiency of every setting on every scene"});
    return result;
}

}  // namespace triad
