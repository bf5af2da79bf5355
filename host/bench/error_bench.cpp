#include "bench/error_bench.h"

#include <algorithm>

namespace triad {
namespace {

void append(std::string& names, const std::string& scene, const std::string& setting) {
    names += (names.empty() ? "" : "; ") + scene + ", " + setting;
}

}  // namespace

const ErrorScene& ErrorBench::scene_of(const ErrorCurve& curve) const {
    return *std::find_if(scenes.begin(), scenes.end(),
                         [&](const ErrorScene& s) { return s.name == curve.scene; });
}

bool ErrorBench::right() const {
    return std::all_of(curves.begin(), curves.end(), [](const ErrorCurve& c) { return c.right; });
}

std::string ErrorBench::wrong() const {
    std::string names;
    for (const ErrorCurve& c : curves)
        if (!c.right) append(names, c.scene, c.setting);
    return names;
}

std::string ErrorBench::worse() const {
    std::string names;
    for (const ErrorChange& c : changes)
        if (c.verdict == ErrorChange::Verdict::worse) append(names, c.scene, c.setting);
    return names;
}

}  // namespace triad
