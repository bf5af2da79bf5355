#include "bench/error_bench.h"

#include <algorithm>

namespace triad {

const ErrorScene& ErrorBench::scene_of(const ErrorCurve& curve) const {
    return *std::find_if(scenes.begin(), scenes.end(),
                         [&](const ErrorScene& s) { return s.name == curve.scene; });
}

bool ErrorBench::right() const {
    return std::all_of(curves.begin(), curves.end(), [](const ErrorCurve& c) { return c.right; });
}

}  // namespace triad
