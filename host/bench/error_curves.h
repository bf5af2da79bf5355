#pragma once
/// From the rows of runs to curves: medians, slopes, efficiency, time to equal error. docs/bench.md has the
/// rules.
#include <span>

#include "bench/error_bench.h"

namespace triad {

/// A curve for every (scene, setting) in the order of first appearance, without pictures and verdicts. Rows
/// of one repetition are in the order of rising spp.
std::vector<ErrorCurve> curves_of(std::span<const ErrorRun> runs);

/// The rows of one (scene, setting): [repetition][budget].
std::vector<std::vector<ErrorRun>> runs_of(std::span<const ErrorRun> runs, const std::string& scene,
                                           const std::string& setting);

/// The least median relMSE that both reach at budgets where the reference is good enough; none: there is
/// none.
std::optional<double> common_error(const ErrorCurve& a, const ErrorCurve& b);

/// The logarithm of the time to a relMSE, of every repetition that has one.
std::vector<double> log_times(const std::vector<std::vector<ErrorRun>>& repetitions, double relmse);

/// "Faster or slower beyond noise" against older runs, for every (scene, setting) that is in both: Welch's t
/// on the logarithms of the times to the error that both reach, two-sided, 5 % shared out over all
/// comparisons (Sidak).
std::vector<ErrorChange> changes_of(std::span<const ErrorRun> before, std::span<const ErrorRun> now);

}  // namespace triad
