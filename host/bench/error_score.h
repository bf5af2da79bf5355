#pragma once
/// One number for a suite of scenes.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/error_bench.h"

namespace triad {

/// How efficient one setting is over all scenes of a suite: 100 times the geometric mean over scenes of e /
/// e0. e is the geometric mean over repetitions of 1 / (relMSE t) at the last budget, t in seconds; e0 is the
/// scene's published baseline. Twice the score: the same error in half of the time.
struct SettingScore {
    std::string setting;
    /// 95 %, Student's t with the variances of all scenes (Satterthwaite); infinite where a scene has one
    /// repetition only. None: void, or a scene has no runs or a relMSE that is not above 0.
    std::optional<Estimate> score;
    bool is_void = false;  ///< a picture is wrong: there is no score
    std::string why_none;  ///< a sentence, when there is no score
};

/// Scores of all settings, in their order. `baselines`: e0 by scene; every one of them is needed.
std::vector<SettingScore> score_settings(const ErrorBench& bench,
                                         const std::map<std::string, double>& baselines);

/// e of the definition above for one scene and setting; none without runs or with a relMSE that is not above
/// 0.
std::optional<double> scene_efficiency(const ErrorBench& bench, const std::string& scene,
                                       const std::string& setting);

}  // namespace triad
