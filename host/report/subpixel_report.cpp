#include "report/subpixel_report.h"

#include <algorithm>

#include "base/text.h"

namespace triad {

std::vector<std::string> scenes_of(const std::vector<SubpixelRow>& rows) {
    std::vector<std::string> names;
    for (const SubpixelRow& row : rows)
        if (std::find(names.begin(), names.end(), row.scene) == names.end()) names.push_back(row.scene);
    return names;
}

bool is_of(const SubpixelRow& row, const PanelView& view) {
    return row.panel == view.panel.name && row.ppd == view.ppd;
}

Json rows_of(const SubpixelReport& report) {
    Json rows = Json::array();
    for (const SubpixelRow& row : report.rows) {
        rows.push_back({{"scene", row.scene},
                        {"panel", row.panel},
                        {"ppd", row.ppd},
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
        csv += quoted(r.scene) + "," + quoted(r.panel) +
               format(",%g,%s,%s,%g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,", r.ppd, r.eye.c_str(), r.method.c_str(),
                      r.rays_per_pixel, r.error.value, r.error.low, r.error.high, r.seconds, r.lightness,
                      r.colour);
        csv += r.over_triad
                   ? format("%.6g,%.6g,%.6g\n", r.over_triad->value, r.over_triad->low, r.over_triad->high)
                   : ",,\n";
    }
    return csv;
}

SubpixelVerdict verdict_of(const std::vector<SubpixelRow>& rows) {
    SubpixelVerdict verdict;
    for (const SubpixelRow& row : rows) {
        if (!is_compared(row)) continue;
        ++verdict.comparisons;
        verdict.worse += row.over_triad->low > 0;
        if (beats_triad(row)) verdict.better.push_back(row);
    }
    return verdict;
}

std::string summary_of(const SubpixelReport& report) {
    std::string text;
    for (const PanelView& view : report.plan.displays)
        for (const std::string& scene : scenes_of(report.rows))
            for (const unsigned rays : report.plan.rays) {
                std::vector<const SubpixelRow*> rows;
                for (const SubpixelRow& row : report.rows)
                    if (is_of(row, view) && row.scene == scene && row.rays == rays && row.eye == "scielab")
                        rows.push_back(&row);
                std::sort(rows.begin(), rows.end(),
                          [](auto* a, auto* b) { return a->error.value < b->error.value; });
                text += format("%s, %g ppd, %s, %u rays:", view.panel.name.c_str(), view.ppd, scene.c_str(),
                               rays);
                for (const SubpixelRow* row : rows)
                    text += format(" %s %.3g", row->method.c_str(), row->error.value);
                text += "\n";
            }
    const SubpixelVerdict verdict = verdict_of(report.rows);
    for (const SubpixelRow& row : verdict.better)
        text +=
            format("better than triad: %s, %g ppd, %s, %s, %s, %g rays: by %.3g (%.3g to %.3g)\n",
                   row.panel.c_str(), row.ppd, row.scene.c_str(), row.eye.c_str(), row.method.c_str(),
                   row.rays_per_pixel, -row.over_triad->value, -row.over_triad->high, -row.over_triad->low);
    return text +
           format("of %zu comparisons at equal rays %zu are significantly better than triad, %zu worse\n",
                  verdict.comparisons, verdict.better.size(), verdict.worse);
}

}  // namespace triad
