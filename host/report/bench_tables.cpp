#include "report/bench_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text.h"
#include "page/aligned.h"
#include "report/error_words.h"

namespace triad {
namespace {

/// JSON has no infinity.
Json number(double v) { return std::isfinite(v) ? Json(v) : Json(); }

Json to_json(const std::optional<Estimate>& e) {
    if (!e) return {};
    return {{"value", number(e->value)}, {"low", number(e->low)}, {"high", number(e->high)}};
}

std::string text_of(const std::optional<Estimate>& e, const char* pattern) {
    if (!e) return "-";
    if (!std::isfinite(e->low)) return format("%.3g", e->value);  // a single run has no interval
    return format(pattern, e->value, e->low, e->high);
}

const char* name_of(ErrorChange::Verdict verdict) {
    switch (verdict) {
        case ErrorChange::Verdict::better:
            return "better";
        case ErrorChange::Verdict::worse:
            return "worse";
        case ErrorChange::Verdict::same:
            return "same";
    }
    throw std::logic_error("no such verdict");
}

}  // namespace

std::string table_of(const ErrorBench& bench) {
    std::vector<std::vector<std::string>> lines = {{"scene", "setting", "spp", "seconds", "relMSE", "95 %",
                                                    "FLIP", "slope", "1/(MSE t)", "time ratio", ""}};
    for (const ErrorCurve& c : bench.curves) {
        const ErrorPoint& p = c.points.back();
        lines.push_back({c.scene, c.setting, format("%.6g", p.spp), format("%.3f", p.seconds),
                         format("%.3g", p.relmse.value), format("%.3g..%.3g", p.relmse.low, p.relmse.high),
                         format("%.4f", p.flip), text_of(c.slope, "%.3f (%.3f..%.3f)"),
                         text_of(c.efficiency, "%.3g (%.3g..%.3g)"),
                         text_of(c.time_ratio, "%.3f (%.3f..%.3f)"),
                         c.right ? "" : "VOID: the picture is wrong"});
    }
    std::string text = aligned(lines, 2);
    for (const ErrorCurve& c : bench.curves)
        if (!c.right) text += c.scene + ", " + c.setting + ": " + c.verdict + ".\n";
    if (bench.changes.empty()) return text;
    lines = {{"scene", "setting", "", "time to equal error, new / old", "relMSE, new / old", "p"}};
    for (const ErrorChange& c : bench.changes)
        lines.push_back({c.scene, c.setting, name_of(c.verdict),
                         format("%.3f (%.3f..%.3f)", c.time_ratio.value, c.time_ratio.low, c.time_ratio.high),
                         text_of(c.error_ratio, "%.3f (%.3f..%.3f)"), format("%.2g", c.p)});
    return text + "\n" + aligned(lines, 2);
}

std::string table_of(const std::vector<SettingScore>& scores) {
    std::string text = scores.empty() ? "" : "\n";
    for (const SettingScore& score : scores)
        text +=
            "Score" + (scores.size() > 1 ? " of " + score.setting : "") + ": " + score_words(score) + "\n";
    return text;
}

Json rows_of(const ErrorBench& bench) {
    Json rows = Json::array();
    for (const ErrorCurve& c : bench.curves)
        for (const ErrorPoint& p : c.points)
            rows.push_back({{"scene", c.scene},
                            {"setting", c.setting},
                            {"seconds", p.seconds},
                            {"spp", p.spp},
                            {"relmse", number(p.relmse.value)},
                            {"relmse_low", number(p.relmse.low)},
                            {"relmse_high", number(p.relmse.high)},
                            {"flip", number(p.flip)},
                            {"relmse_trimmed", number(p.relmse_trimmed)},
                            {"fireflies", p.fireflies},
                            {"nan", p.nan},
                            {"fitted", p.fitted}});
    return rows;
}

Json details_of(const ErrorBench& bench, const std::vector<SettingScore>& scores) {
    Json curves = Json::array(), scenes = Json::array(), settings = Json::array(), changes = Json::array();
    for (const ErrorCurve& c : bench.curves)
        curves.push_back(
            {{"scene", c.scene},
             {"setting", c.setting},
             {"slope", to_json(c.slope)},
             {"efficiency", to_json(c.efficiency)},
             {"relmse_efficiency", number(scene_efficiency(bench, c.scene, c.setting).value_or(NAN))},
             {"equal_relmse", c.time_ratio ? Json(c.equal_relmse) : Json()},
             {"time_ratio", to_json(c.time_ratio)},
             {"right", c.right},
             {"verdict", c.verdict}});
    for (const ErrorScene& s : bench.scenes)
        scenes.push_back({{"name", s.name},
                          {"options", s.options},
                          {"scene_hash", s.scene_hash},
                          {"width", s.reference.width},
                          {"height", s.reference.height},
                          {"reference_spp", s.reference_spp},
                          {"reference_relmse", number(s.reference_relmse)},
                          {"reference_seconds", s.reference_seconds}});
    for (const ErrorSetting& s : bench.settings)
        settings.push_back(
            {{"name", s.name}, {"options", s.options}, {"device", s.device}, {"driver", s.driver}});
    for (const ErrorChange& c : bench.changes)
        changes.push_back({{"scene", c.scene},
                           {"setting", c.setting},
                           {"verdict", name_of(c.verdict)},
                           {"time_ratio", to_json(c.time_ratio)},
                           {"error_ratio", to_json(c.error_ratio)},
                           {"p", c.p}});
    Json scored = Json::array();
    for (const SettingScore& s : scores)
        scored.push_back({{"setting", s.setting},
                          {"score", to_json(s.score)},
                          {"void", s.is_void},
                          {"why_none", s.why_none}});
    return {{"repetitions", bench.repetitions},
            {"complete", !bench.interrupted},
            {"right", bench.right()},
            {"curves", curves},
            {"scenes", scenes},
            {"settings", settings},
            {"changes", changes},
            {"scores", scored}};
}

}  // namespace triad
