// Taps in the user's cache, and what is planned of them.
#include "display/tap_plan.h"
#include "fuzz/targets/target.h"
#include "panel/design.h"

using namespace triad;

TRIAD_FUZZ_TARGET(kept_taps) {
    const auto taps = taps_of_json(fuzz::text_of(input), *builtin_panel("rgb"), {});
    if (!taps) return;
    const TapPlan plan(*taps, true);
    const PlaneShape shape{4096, 1 << 20};
    if (plan.separable()) plan.down_sums(shape), plan.across_sums(shape);
    plan.sums(shape);
}
