#include "bench/error_score.h"

#include <cmath>

#include "metric/statistics.h"

namespace triad {
namespace {

/// log(1 / (relMSE t)) of every repetition at its last budget; not finite where relMSE is not above 0.
std::vector<double> log_efficiencies(const ErrorBench& bench, const std::string& scene,
                                     const std::string& setting) {
    std::map<unsigned, const ErrorRun*> last;
    for (const ErrorRun& run : bench.runs) {
        if (run.scene != scene || run.setting != setting) continue;
        const ErrorRun*& latest = last[run.repetition];
        if (!latest || run.spp > latest->spp) latest = &run;
    }
    std::vector<double> logs;
    for (const auto& [repetition, run] : last) logs.push_back(-std::log(run->relmse * run->seconds));
    return logs;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

SettingScore score_of(const ErrorBench& bench, const std::string& setting,
                      const std::map<std::string, double>& baselines) {
    SettingScore result{setting, std::nullopt, false, ""};
    for (const ErrorCurve& curve : bench.curves) {
        if (curve.setting != setting || curve.right) continue;
        result.is_void = true;
        result.why_none = "The picture of " + curve.scene + " is wrong: " + curve.verdict + ".";
        return result;
    }
    if (baselines.empty()) {
        result.why_none = "There are no baselines.";
        return result;
    }
    double sum = 0, variance = 0, variance_squares = 0;
    for (const auto& [scene, baseline] : baselines) {
        const std::vector<double> logs = log_efficiencies(bench, scene, setting);
        const double mean = logs.empty() ? NAN : mean_of(logs);
        if (!std::isfinite(mean)) {
            result.why_none = logs.empty() ? "There is no run of " + scene + "."
                                           : "The error of " + scene + " is lost in that of its reference.";
            return result;
        }
        sum += mean - std::log(baseline);
        const auto n = static_cast<double>(logs.size());
        double squares = 0;
        for (const double v : logs) squares += (v - mean) * (v - mean);
        const double v = n > 1 ? squares / (n - 1) / n : INFINITY;
        variance += v, variance_squares += v * v / (n - 1);
    }
    const auto scenes = static_cast<double>(baselines.size());
    const double value = sum / scenes, error = std::sqrt(variance) / scenes;
    const double reach = error > 0 && std::isfinite(error)
                             ? error * student_t_critical(0.05, variance * variance / variance_squares)
                             : error;
    result.score =
        Estimate{100 * std::exp(value), 100 * std::exp(value - reach), 100 * std::exp(value + reach)};
    return result;
}

}  // namespace

std::vector<SettingScore> score_settings(const ErrorBench& bench,
                                         const std::map<std::string, double>& baselines) {
    std::vector<SettingScore> scores;
    for (const ErrorSetting& setting : bench.settings)
        scores.push_back(score_of(bench, setting.name, baselines));
    return scores;
}

std::optional<double> scene_efficiency(const ErrorBench& bench, const std::string& scene,
                                       const std::string& setting) {
    const std::vector<double> logs = log_efficiencies(bench, scene, setting);
    const double e = logs.empty() ? NAN : std::exp(mean_of(logs));
    return std::isfinite(e) ? std::optional(e) : std::nullopt;
}

}  // namespace triad
