#pragma once
/// Do two sets of independently rendered batches show the same picture? Tile means and Welch's t test, with
/// the significance shared out over all comparisons. Batches must differ in seed: within one Owen-Sobol
/// sequence the scatter of samples is not the error of their mean.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace triad {

/// Probability that Student's t with `dof` > 0 degrees of freedom is at least |t| away from zero, two-sided.
/// `dof` need not be an integer and may be infinite (normal, which everything above 1e8 is taken as).
/// I_x(dof/2, 1/2) at x = dof / (dof + t^2), DLMF 8.17, to about 1e-15 dof of its value.
double student_t_tail(double t, double dof);

/// The t whose two-sided tail is `significance`, in (0, 1].
double student_t_critical(double significance, double dof);

/// Significance of each of `comparisons` independent tests that together are wrong with probability `family`:
/// 1 - (1 - family)^(1/comparisons) (Sidak 1967). Never too much for tests that depend on each other
/// positively.
double sidak(double family, std::size_t comparisons);

/// Welch's t of two samples of at least two values each.
struct WelchTest {
    double mean_a = 0, mean_b = 0;
    double t = 0;    ///< of mean_b - mean_a
    double dof = 0;  ///< by Welch and Satterthwaite
    double p = 1;    ///< two-sided
};

/// `rounding`: standard error that each mean has from rounding alone, relative to it, so that values without
/// noise may differ by that much (Welch 1947; Satterthwaite 1946). Throws std::invalid_argument for less than
/// two values.
WelchTest welch_test(std::span<const double> a, std::span<const double> b, double rounding = 0.0);

/// One rendering: interleaved RGB, row by row.
struct Batch {
    unsigned width = 0, height = 0;
    std::vector<float> rgb;
};

struct AgreementPlan {
    unsigned tile = 16;      ///< edge of a tile in pixels; those at the right and bottom may be smaller
    double family = 1e-6;    ///< probability that equal pictures are called different
    double rounding = 1e-6;  ///< see welch_test()
};

/// Where two pictures differ most, by the p of a comparison over its limit.
struct Agreement {
    bool agree = true;
    std::size_t comparisons = 0;  ///< tiles times channels, plus the three means of the whole picture
    std::size_t rejected = 0;     ///< how many of them differ significantly
    WelchTest worst;              ///< the least probable one
    std::string worst_place;      ///< "tile 3, 4, channel G" or "whole picture, channel R"
    double critical_t = 0;        ///< what |worst.t| was allowed to be

    std::string sentence() const;
};

/// Compares the means of every tile and of the whole picture, each kind with half the family's significance.
/// Any value that is not finite makes the pictures differ. Throws std::invalid_argument unless there are at
/// least two batches of each, all of one size.
Agreement compare_pictures(std::span<const Batch> a, std::span<const Batch> b,
                           const AgreementPlan& plan = {});

}  // namespace triad
