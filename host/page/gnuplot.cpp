#include "page/gnuplot.h"

#include <iterator>

#include "base/child_process.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "base/text.h"

namespace triad {
namespace {

constexpr Pen pens[] = {
    {"rgb(  0, 114, 178)", "#5ab4ee", "#0072b2"}, {"rgb(213,  94,   0)", "#ff8a3c", "#d55e00"},
    {"rgb(  0, 158, 115)", "#2fcf9f", "#009e73"}, {"rgb(204, 121, 167)", "#e39ac4", "#cc79a7"},
    {"rgb(230, 159,   0)", "#f0b429", "#e69f00"}, {"rgb( 86, 180, 233)", "#86cdf5", "#56b4e9"},
    {"rgb( 90,  90,  90)", "#b8b8b8", "#5a5a5a"}};
static_assert(std::size(pens) == pen_count);

/// CSS that shows what has one colour as another.
std::string recoloured(const std::string& from, const std::string& to) {
    std::string css;
    for (const std::string what : {"stroke", "fill", "color"})
        css += " [" + what + "=\"" + from + "\"]{" + what + ":" + to + "}";
    return css;
}

std::string restyled(std::string svg) {
    std::string style = "<style>@media (prefers-color-scheme: dark) {";
    for (const char* ink : {"black", "rgb(  0,   0,   0)", "rgb(0,0,0)"}) style += recoloured(ink, "#d6dae0");
    for (const Pen& pen : pens) style += recoloured(pen.light, pen.dark);
    style += "}</style>";
    const auto end = svg.find("</desc>");
    if (end != std::string::npos) svg.insert(end + 7, "\n" + style);
    return svg;
}

}  // namespace

const Pen& pen_of(std::size_t i) { return pens[i % pen_count]; }

std::string plot_head(const std::string& title, double height) {
    return format("set terminal svg size 480,%d dynamic font 'sans-serif,15' noenhanced\n", int(height)) +
           "set encoding utf8\nset title " + gnuplot_quoted(title) +
           "\nset border lc rgb 'black'\nset grid lc rgb '#888888' lw 0.5 dt 1\nset key font ',14'\n";
}

std::string gnuplot_quoted(const std::string& name) {
    std::string out = "'";
    for (const char c : name) {
        if (static_cast<unsigned char>(c) < 32 || c == 127)
            out += ' ';
        else if (c == '\'')
            out +=
                "\xe2\x80\x99";  // gnuplot's own way to write one inside fails at the beginning of a string
        else
            out += c;
    }
    return out + "'";
}

std::string draw_with_gnuplot(const std::string& script, const std::string& name, std::string& missing) {
    const TemporaryFolder folder;
    const auto script_path = folder.path() / "plot.gp", picture_path = folder.path() / "plot.svg",
               log_path = folder.path() / "log";
    write_file(script_path, script);
    const auto status = run_program({"gnuplot", script_path.string()}, picture_path, log_path);
    if (!status) {
        missing =
            "There are no plots, because the program gnuplot is not installed (Debian package: gnuplot-nox).";
        return {};
    }
    if (*status != 0) {
        const auto log = read_file(log_path, 1 << 20);
        missing = "gnuplot failed to draw " + name + " (exit status " + std::to_string(*status) +
                  "): " + std::string(log.begin(), log.end());
        return {};
    }
    const auto bytes = read_file(picture_path);
    return restyled({bytes.begin(), bytes.end()});
}

}  // namespace triad
