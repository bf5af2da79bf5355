#pragma once
/// Numbers and verdicts of an error bench as people read them; plain text.
#include <string>

#include "bench/error_bench.h"
#include "bench/error_score.h"

namespace triad {

/// Three digits: "0.00123", "1.23e-05", "45.6", "12300".
std::string digits3(double value);

/// A number of samples or pixels: "64", "2048", "12.5".
std::string count_words(double value);

/// "low to high".
std::string interval_words(const Estimate& estimate);

/// What the curve says about its setting in one sentence. `first`: the scene's first setting.
struct VerdictWords {
    std::string words;
    enum class Tone { plain, good, bad } tone = Tone::plain;
};
VerdictWords verdict_of(const ErrorCurve& curve, const ErrorCurve& first);
VerdictWords verdict_of(const ErrorChange& change);

/// "104 (98.0 to 111)", or why there is none.
std::string score_words(const SettingScore& score);

}  // namespace triad
