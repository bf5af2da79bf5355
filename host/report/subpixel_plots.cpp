#include "report/subpixel_plots.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "page/html.h"

namespace triad {
namespace {

constexpr double width = 420, left = 118, right = 12, line = 17;  // px of the drawing

/// A logarithmic axis over some values, with room at its ends.
struct Axis {
    double low, high, from, to;

    Axis(double least, double most, double begin, double end)
        : low(std::log10(least) - 0.04), high(std::log10(most) + 0.04), from(begin), to(end) {}
    double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
    /// 1, 2, 5 of every decade; decades alone where there are many.
    std::vector<double> marks() const {
        std::vector<double> values;
        for (int decade = int(std::floor(low)); decade <= int(std::ceil(high)); ++decade)
            for (const double step : {1.0, 2.0, 5.0}) {
                const double value = step * std::pow(10.0, decade);
                if ((step == 1 || high - low < 2) && std::log10(value) > low && std::log10(value) < high)
                    values.push_back(value);
            }
        return values;
    }
};

std::string text(double x, double y, const char* anchor, const std::string& words, const char* more = "") {
    return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", x, y, anchor, more) +
           html_escape(words) + "</text>\n";
}

std::string stroke(double x0, double y0, double x1, double y1, const char* style) {
    return format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x0, y0, x1, y1, style);
}

std::string begin(double height, const std::string& name) {
    return format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %.0f\" role=\"img\" "
               "style=\"width:100%%;max-width:46rem;display:block;color:inherit\" fill=\"currentColor\" "
               "stroke=\"none\" font-family=\"system-ui, sans-serif\" font-size=\"11\" aria-label=\"",
               width, height) +
           html_escape(name) + "\">\n";
}

constexpr char faint[] = "stroke=\"currentColor\" stroke-opacity=\".2\" stroke-width=\".7\"";

}  // namespace

std::string method_family(const std::string& method) {
    return method.starts_with("ssaa:") ? "ssaa:N" : method;
}

std::map<std::string, char> method_letters(const std::vector<SubpixelRow>& rows) {
    std::map<std::string, double> least;
    for (const SubpixelRow& row : rows) {
        const auto found = least.emplace(method_family(row.method), row.error.value).first;
        found->second = std::min(found->second, row.error.value);
    }
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, error] : least) order.emplace_back(error, name);
    std::sort(order.begin(), order.end());
    std::map<std::string, char> letters;
    for (std::size_t i = 0; i < order.size(); ++i)
        letters[order[i].second] = i < 26 ? char('A' + i) : char('a' + (i - 26) % 26);
    return letters;
}

std::string ranked_dots(std::vector<SubpixelRow> rows, const std::map<std::string, char>& letters) {
    if (rows.empty()) return "";
    std::sort(rows.begin(), rows.end(),
              [](const SubpixelRow& a, const SubpixelRow& b) { return a.error.value < b.error.value; });
    const double floor = 1e-4;
    double least = rows.back().error.high, most = floor;
    for (const SubpixelRow& row : rows)
        least = std::min(least, std::max(row.error.low, floor)), most = std::max(most, row.error.high);
    const double bottom = 8 + line * double(rows.size());
    const Axis x(least, std::max(most, least * 1.1), left, width - right);
    std::string svg = begin(bottom + 32, "Methods by perceived error");
    for (const double mark : x.marks()) {
        svg += stroke(x.at(mark), 4, x.at(mark), bottom, faint);
        svg += text(x.at(mark), bottom + 13, "middle", format("%g", mark));
    }
    svg += text((left + width - right) / 2, bottom + 27, "middle", "perceived error, 95 % intervals");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const SubpixelRow& row = rows[i];
        const double y = 8 + line * (double(i) + 0.5);
        const bool own = row.method == subpixel_yardstick;
        const char* bold = own ? " font-weight=\"700\"" : "";
        svg += text(2, y + 4, "start", std::string(1, letters.at(method_family(row.method))), bold);
        svg += text(16, y + 4, "start", row.method, bold);
        svg += stroke(x.at(std::max(row.error.low, floor)), y, x.at(std::max(row.error.high, floor)), y,
                      own ? "stroke=\"currentColor\" stroke-width=\"3\""
                          : "stroke=\"currentColor\" stroke-width=\"1.3\"");
        svg += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"/>\n", x.at(std::max(row.error.value, floor)),
                      y, own ? "5" : "3.5");
    }
    return svg + "</svg>\n";
}

std::string error_for_time(const std::vector<SubpixelRow>& rows, const std::map<std::string, char>& letters) {
    if (rows.empty()) return "";
    std::vector<std::pair<double, double>> points;  // seconds, error
    for (const SubpixelRow& row : rows)
        points.emplace_back(std::max(row.seconds, 1e-6), std::max(row.error.value, 1e-4));
    double least_x = points[0].first, most_x = least_x, least_y = points[0].second, most_y = least_y;
    for (const auto& [seconds, error] : points) {
        least_x = std::min(least_x, seconds), most_x = std::max(most_x, seconds);
        least_y = std::min(least_y, error), most_y = std::max(most_y, error);
    }
    constexpr double edge = 44, bottom = 330;
    const Axis x(least_x, std::max(most_x, least_x * 1.1), edge, width - right);
    const Axis y(least_y, std::max(most_y, least_y * 1.1), bottom, 8);
    std::string svg = begin(bottom + 34, "Perceived error against seconds");
    for (const double mark : x.marks()) {
        svg += stroke(x.at(mark), 8, x.at(mark), bottom, faint);
        svg += text(x.at(mark), bottom + 13, "middle", format("%g", mark));
    }
    for (const double mark : y.marks()) {
        svg += stroke(edge, y.at(mark), width - right, y.at(mark), faint);
        svg += text(edge - 4, y.at(mark) + 4, "end", format("%g", mark));
    }
    svg += text((edge + width - right) / 2, bottom + 29, "middle", "seconds, without compilation");
    svg += text(10, (bottom + 8) / 2, "middle", "perceived error",
                format(" transform=\"rotate(-90 10 %g)\"", (bottom + 8) / 2).c_str());
    std::vector<std::pair<double, double>> front = points;
    std::sort(front.begin(), front.end());
    std::string path;
    double best = INFINITY;
    for (const auto& [seconds, error] : front) {
        if (error >= best) continue;
        // Steps: until something better comes, the last is the best that there is.
        path += path.empty() ? format("M%.1f %.1f", x.at(seconds), y.at(error))
                             : format("H%.1fV%.1f", x.at(seconds), y.at(error));
        best = error;
    }
    svg += "<path d=\"" + path + format("H%.1f", width - right) +
           "\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.2\" stroke-opacity=\".6\"/>\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool own = rows[i].method == subpixel_yardstick;
        svg += text(x.at(points[i].first), y.at(points[i].second) + 4, "middle",
                    std::string(1, letters.at(method_family(rows[i].method))),
                    own ? " font-weight=\"700\" font-size=\"15\"" : "");
    }
    return svg + "</svg>\n";
}

}  // namespace triad
