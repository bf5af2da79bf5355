#include "report/error_words.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace triad {

std::string digits3(double value) {
    if (!std::isfinite(value))
        return std::isnan(value) ? "not a number" : value > 0 ? "infinite" : "-infinite";
    char text[64];
    const double size = std::abs(value);
    if (size >= 100 && size < 1e6) {
        const double step = std::pow(10.0, std::floor(std::log10(size)) - 2);
        std::snprintf(text, sizeof text, "%.0f", std::round(value / step) * step);
    } else if (size >= 1e-4 && size < 100) {
        std::snprintf(text, sizeof text, "%#.3g", value);
    } else {
        std::snprintf(text, sizeof text, value == 0 ? "0" : "%.2e", value);
    }
    return text;
}

std::string count_words(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value == std::round(value) ? "%.0f" : "%.3g", value);
    return text;
}

std::string interval_words(const Estimate& e) { return digits3(e.low) + " to " + digits3(e.high); }

VerdictWords verdict_of(const ErrorCurve& curve, const ErrorCurve& first) {
    using Tone = VerdictWords::Tone;
    if (!curve.right) return {"Void: the picture is wrong. " + curve.verdict, Tone::bad};
    if (&curve == &first) return {"The picture is right.", Tone::plain};
    if (!curve.time_ratio)
        return {"The picture is right; no error in common with " + first.setting + ".", Tone::plain};
    const Estimate& ratio = *curve.time_ratio;
    const std::string to = " to relMSE " + digits3(curve.equal_relmse);
    if (ratio.high < 1)
        return {digits3(1 / ratio.value) + " times as fast as " + first.setting + to + " (" +
                    interval_words({1 / ratio.value, 1 / ratio.high, 1 / ratio.low}) + ").",
                Tone::good};
    if (ratio.low > 1)
        return {"Takes " + digits3(ratio.value) + " times as long as " + first.setting + to + " (" +
                    interval_words(ratio) + ").",
                Tone::bad};
    return {"No difference from " + first.setting + " beyond noise: takes " + digits3(ratio.value) +
                " times as long" + to + " (" + interval_words(ratio) + ").",
            Tone::plain};
}

VerdictWords verdict_of(const ErrorChange& change) {
    const std::string words = ": takes " + digits3(change.time_ratio.value) +
                              " times as long to the same error (" + interval_words(change.time_ratio) + ")";
    if (change.verdict == ErrorChange::Verdict::better) return {"Better" + words, VerdictWords::Tone::good};
    if (change.verdict == ErrorChange::Verdict::worse) return {"Worse" + words, VerdictWords::Tone::bad};
    return {"The same within noise" + words, VerdictWords::Tone::plain};
}

std::string score_words(const SettingScore& score) {
    if (!score.score) return (score.is_void ? "void: " : "none: ") + score.why_none;
    return digits3(score.score->value) + " (" + interval_words(*score.score) + ")";
}

}  // namespace triad
