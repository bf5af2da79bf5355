#pragma once
/// What `triad bench error` found, as plain data: error against samples and against time, for scenes x
/// settings x repetitions. docs/bench.md says how it is measured.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/reference_error.h"
#include "device/device.h"
#include "metric/repetitions.h"

namespace triad {

/// One run read at one of its budgets: a row of the CSV.
struct ErrorRun {
    std::string scene, setting;
    unsigned repetition = 0;
    std::uint32_t seed = 0;
    double spp = 0;      ///< per pixel; the mean where pixels differ
    double seconds = 0;  ///< of rendering alone since the run began: no reading, no measuring
    std::uint64_t rays = 0;
    /// Of the picture, the reference's own variance subtracted: unbiased, so that a value far below that
    /// variance can come out negative.
    double mse = 0, relmse = 0;
    double reference_relmse = 0;  ///< what was subtracted from relmse
    double relmse_trimmed = 0;    ///< without the 0.1 % of the pixels that have most of it
    double flip = 0;              ///< mean LDR-FLIP, tone-mapped as the render's PNG
    std::uint64_t fireflies = 0;  ///< pixels that are more than 20 times as bright as the reference
    std::uint64_t nan = 0;        ///< samples that were not finite (they count as black)
};

/// Runs of one setting at one budget: medians over repetitions.
struct ErrorPoint {
    double spp = 0, seconds = 0;
    Estimate relmse;  ///< median, percentile bootstrap over repetitions
    double relmse_trimmed = 0, flip = 0, fireflies = 0;
    std::uint64_t nan = 0;  ///< of all repetitions together
    /// The error is so far above the reference's own that the fits use this point.
    bool fitted = false;
};

/// One setting on one scene.
struct ErrorCurve {
    std::string scene, setting;
    std::vector<ErrorPoint> points;  ///< by rising spp
    /// Of log sqrt(relMSE) against log spp, over the fitted points; none: fewer than two.
    std::optional<Estimate> slope;
    std::optional<Estimate> efficiency;  ///< 1 / (MSE t), t in seconds, at the last fitted point
    /// Time to `equal_relmse` over that of the scene's first setting (below 1: faster; exactly 1 for the
    /// first itself); none: the two curves have no error in common.
    std::optional<Estimate> time_ratio;
    double equal_relmse = 0;  ///< the least error that both settings reach
    /// Whether the mean of all runs is the reference's picture, by a test of tile means (family 1e-6); if
    /// not, the setting's numbers are void.
    bool right = true;
    std::string verdict;  ///< the sentence of that test
    /// Of repetition 0 at the last budget.
    RgbImage picture;              ///< scene-linear
    RgbImage display;              ///< tone-mapped, display-linear, in [0, 1]
    std::vector<float> rel_error;  ///< per pixel: mean over channels of (x - r) / sqrt(r^2 + 0.01), signed
    std::vector<float> flip_map;   ///< per pixel, in [0, 1]
};

struct ErrorScene {
    std::string name, options;  ///< `options`: what was added to `triad render`, the file included
    std::string scene_hash;
    RgbImage reference, reference_display;  ///< as in ErrorCurve
    double reference_spp = 0;
    double reference_relmse = 0;   ///< its own variance, as relMSE
    double reference_seconds = 0;  ///< that this run spent on it; 0: it was kept from before
};

struct ErrorSetting {
    std::string name, options;
    std::string device, driver;
};

/// Against an older CSV: one (scene, setting) that is in both.
struct ErrorChange {
    enum class Verdict { same, better, worse };
    std::string scene, setting;
    Estimate time_ratio;                  ///< time to equal error, new over old
    std::optional<Estimate> error_ratio;  ///< relMSE at the most samples that both have, new over old
    Verdict verdict = Verdict::same;
    double p = 1;  ///< of the time, two-sided (Welch's t on logarithms)
};

struct ErrorBench {
    std::vector<ErrorScene> scenes;
    std::vector<ErrorSetting> settings;
    DeviceInfo device;  ///< of the first setting
    unsigned repetitions = 0;
    std::vector<ErrorRun> runs;      ///< in the order they were made
    std::vector<ErrorCurve> curves;  ///< scene by scene, settings in their order
    std::vector<ErrorChange> changes;
    bool interrupted = false;  ///< what is here was measured; the rest is missing

    const ErrorScene& scene_of(const ErrorCurve& curve) const;
    bool right() const;  ///< no setting's picture is wrong
    /// "scene, setting; scene, setting": whose picture is not the reference's.
    std::string wrong() const;
    /// The same of what became worse than before.
    std::string worse() const;
};

}  // namespace triad
