#include "measure/error_score.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace triad {
namespace {

struct Last {
    double spp = 0, relmse = 0, seconds = 0;
};

/// The runs at their last budget, one of each repetition.
std::vector<Last> last_runs(const ErrorBench& bench, const std::string& scene, const std::string& setting) {
    std::map<unsigned, Last> by_repetition;
    for (const ErrorRun& run : bench.runs) {
        if (run.scene != scene || run.setting != setting) continue;
        Last& last = by_repetition[run.repetition];
        if (run.spp > last.spp) last = {run.spp, run.relmse, run.seconds};
    }
    std::vector<Last> runs;
    for (const auto& [repetition, last] : by_repetition) runs.push_back(last);
    return runs;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// -log(relMSE t) of medians over the drawn runs; not a number where relMSE is not above 0.
double log_efficiency(const std::vector<Last>& runs, const std::vector<std::size_t>& drawn) {
    std::vector<double> relmse, seconds;
    for (const std::size_t i : drawn) relmse.push_back(runs[i].relmse), seconds.push_back(runs[i].seconds);
    return -std::log(median(std::move(relmse)) * median(std::move(seconds)));
}

std::vector<std::size_t> all_of(const std::vector<Last>& runs) {
    std::vector<std::size_t> all(runs.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
}

SettingScore score_of(const ErrorBench& bench, const std::string& setting,
                      const std::map<std::string, double>& baselines) {
    SettingScore result{setting, std::nullopt, false, ""};
    for (const ErrorCurve& curve : bench.curves) {
        if (curve.setting != setting || curve.right) continue;
        result.is_void = true;
        result.why_none = "The picture of " + curve.scene + " is wrong: " + curve.verdict;
        return result;
    }
    struct Scene {
        std::vector<Last> runs;
        double log_baseline;
    };
    std::vector<Scene> scenes;
    double sum = 0;
    for (const auto& [name, baseline] : baselines) {
        Scene scene{last_runs(bench, name, setting), std::log(baseline)};
        const double e = scene.runs.empty() ? 0 : log_efficiency(scene.runs, all_of(scene.runs));
        if (scene.runs.empty() || !std::isfinite(e)) {
            result.why_none = scene.runs.empty()
                                  ? "There is no run of " + name + "."
                                  : "The error of " + name + " is lost in that of its reference.";
            return result;
        }
        sum += e - scene.log_baseline;
        scenes.push_back(std::move(scene));
    }
    if (scenes.empty()) {
        result.why_none = "There are no baselines.";
        return result;
    }
    const auto n = static_cast<double>(scenes.size());
    constexpr unsigned draws = 2000;
    std::mt19937_64 random(1);
    std::vector<double> scores;
    for (unsigned draw = 0; draw < draws; ++draw) {
        double drawn_sum = 0;
        for (const Scene& scene : scenes) {
            std::vector<std::size_t> drawn(scene.runs.size());
            for (std::size_t& i : drawn) i = random() % scene.runs.size();
            drawn_sum += log_efficiency(scene.runs, drawn) - scene.log_baseline;
        }
        // A draw whose median error is below 0 knows nothing of the efficiency: the top of the interval is
        // open.
        scores.push_back(std::isnan(drawn_sum) ? INFINITY : 100 * std::exp(drawn_sum / n));
    }
    std::sort(scores.begin(), scores.end());
    result.score = Estimate{100 * std::exp(sum / n), scores[std::size_t(0.025 * (draws - 1))],
                            scores[std::size_t(0.975 * (draws - 1) + 0.5)]};
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
    const std::vector<Last> runs = last_runs(bench, scene, setting);
    if (runs.empty()) return std::nullopt;
    const double e = std::exp(log_efficiency(runs, all_of(runs)));
    return std::isfinite(e) ? std::optional(e) : std::nullopt;
}

}  // namespace triad
