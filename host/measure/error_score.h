#pragma once
/// One number for a suite of scenes.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/error_bench.h"

namespace triad {

/// How efficient one setting is over all scenes of a suite: 100 times the geometric mean over scenes of
/// e / e0, where e = 1 / (relMSE t) with the medians over repetitions of relMSE and of t (seconds) at the
/// last budget, and e0 is the scene's published baseline. Twice the score: the same error in half of the
/// time.
struct SettingScore {
    std::string setting;
    /// 95 %, percentile bootstrap over repetitions, each scene's drawn apart. None: void, or some scene has
    /// no baseline or a median relMSE that is not above 0, or a scene is missing.
    std::optional<Estimate> score;
    bool is_void = false;  ///< a picture is wrong: there is no score
    std::string why_none;  ///< a sentence, when there is no score
};

/// Scores of all settings, in their order. `baselines`: e0 by scene; every one of them is needed.
std::vector<SettingScore> score_settings(const ErrorBench& bench,
                                         const std::map<std::string, double>& baselines);

/// e of the definition above for one scene and setting, for a new baseline; none without runs or with a
/// median relMSE that is not above 0.
std::optional<double> scene_efficiency(const ErrorBench& bench, const std::string& scene,
                                       const std::string& setting);

}  // namespace triad
