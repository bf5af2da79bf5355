#include "bench/error_curves.h"

#include <algorithm>
#include <cmath>

#include "metric/statistics.h"

namespace triad {
namespace {

using Repetitions = std::vector<std::vector<ErrorRun>>;

constexpr double changes_significance = 0.05;

/// Values of one budget over all repetitions that came so far.
template <class Member>
std::vector<double> values_at(const Repetitions& repetitions, std::size_t budget, Member member) {
    std::vector<double> values;
    for (const auto& rows : repetitions)
        if (budget < rows.size()) values.push_back(double(rows[budget].*member));
    return values;
}

ErrorPoint point_of(const Repetitions& repetitions, std::size_t budget) {
    const auto at = [&](auto member) { return values_at(repetitions, budget, member); };
    ErrorPoint point;
    point.spp = median(at(&ErrorRun::spp));
    point.seconds = median(at(&ErrorRun::seconds));
    point.relmse = median_estimate(at(&ErrorRun::relmse));
    point.relmse_trimmed = median(at(&ErrorRun::relmse_trimmed));
    point.flip = median(at(&ErrorRun::flip));
    point.fireflies = median(at(&ErrorRun::fireflies));
    for (const double n : at(&ErrorRun::nan)) point.nan += std::uint64_t(n);
    point.fitted = point.relmse.value > 0 && point.relmse.value >= median(at(&ErrorRun::reference_relmse));
    return point;
}

/// The slope of each repetition by itself: they are independent of each other, the points of one are not.
std::optional<Estimate> slope_of(const Repetitions& repetitions, const std::vector<ErrorPoint>& points) {
    std::vector<double> slopes;
    for (const auto& rows : repetitions) {
        std::vector<double> spp, error;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (points[i].fitted && rows[i].relmse > 0)
                spp.push_back(rows[i].spp), error.push_back(std::sqrt(rows[i].relmse));
        if (const auto slope = fit_power(spp, error)) slopes.push_back(*slope);
    }
    if (slopes.empty()) return {};
    return mean_estimate(slopes);
}

std::optional<Estimate> efficiency_of(const Repetitions& repetitions, const std::vector<ErrorPoint>& points) {
    for (std::size_t i = points.size(); i-- > 0;) {
        if (!points[i].fitted) continue;
        std::vector<double> values;
        for (const auto& rows : repetitions)
            if (i < rows.size() && rows[i].mse > 0 && rows[i].seconds > 0)
                values.push_back(1 / (rows[i].mse * rows[i].seconds));
        if (!values.empty()) return median_estimate(values);
    }
    return {};
}

/// Ratios within repetitions, whose runs had the machine to share and the random numbers in common.
std::optional<Estimate> time_ratio(const Repetitions& first, const Repetitions& other, double relmse) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(first.size(), other.size()); ++i) {
        const auto a = log_times({first[i]}, relmse), b = log_times({other[i]}, relmse);
        if (!a.empty() && !b.empty()) ratios.push_back(std::exp(b[0] - a[0]));
    }
    if (ratios.empty()) return {};
    return geometric_mean_estimate(ratios);
}

double least_fitted(const ErrorCurve& curve) {
    double least = -1;
    for (const ErrorPoint& p : curve.points)
        if (p.fitted) least = p.relmse.value;
    return least;
}

/// Ratio of medians at the most samples that both have.
std::optional<Estimate> error_ratio(const Repetitions& before, const Repetitions& now) {
    for (std::size_t i = now.empty() ? 0 : now[0].size(); i-- > 0;)
        for (const ErrorRun& old : before.empty() ? std::vector<ErrorRun>{} : before[0]) {
            if (old.spp != now[0][i].spp) continue;
            const auto logs = [&](const Repetitions& repetitions) {
                std::vector<double> v;
                for (const auto& rows : repetitions)
                    for (const ErrorRun& r : rows)
                        if (r.spp == old.spp && r.relmse > 0) v.push_back(std::log(r.relmse));
                return v;
            };
            const auto a = logs(before), b = logs(now);
            if (a.size() > 1 && b.size() > 1) return ratio_estimate(a, b);
        }
    return {};
}

}  // namespace

std::vector<std::vector<ErrorRun>> runs_of(std::span<const ErrorRun> runs, const std::string& scene,
                                           const std::string& setting) {
    Repetitions repetitions;
    std::vector<unsigned> numbers;
    for (const ErrorRun& run : runs) {
        if (run.scene != scene || run.setting != setting) continue;
        const auto found = std::find(numbers.begin(), numbers.end(), run.repetition);
        const auto i = std::size_t(found - numbers.begin());
        if (found == numbers.end()) numbers.push_back(run.repetition), repetitions.emplace_back();
        repetitions[i].push_back(run);
    }
    return repetitions;
}

std::vector<ErrorCurve> curves_of(std::span<const ErrorRun> runs) {
    std::vector<ErrorCurve> curves;
    for (const ErrorRun& run : runs) {
        const auto same = [&](const ErrorCurve& c) {
            return c.scene == run.scene && c.setting == run.setting;
        };
        if (std::any_of(curves.begin(), curves.end(), same)) continue;
        ErrorCurve curve{run.scene, run.setting};
        const Repetitions repetitions = runs_of(runs, run.scene, run.setting);
        std::size_t budgets = 0;
        for (const auto& rows : repetitions) budgets = std::max(budgets, rows.size());
        for (std::size_t i = 0; i < budgets; ++i) curve.points.push_back(point_of(repetitions, i));
        curve.slope = slope_of(repetitions, curve.points);
        curve.efficiency = efficiency_of(repetitions, curve.points);
        const auto first = std::find_if(curves.begin(), curves.end(),
                                        [&](const ErrorCurve& c) { return c.scene == run.scene; });
        const ErrorCurve& beside = first == curves.end() ? curve : *first;
        if (const auto error = common_error(beside, curve)) {
            curve.equal_relmse = *error;
            curve.time_ratio =
                &beside == &curve ? Estimate{1, 1, 1}
                                  : time_ratio(runs_of(runs, run.scene, beside.setting), repetitions, *error);
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

std::optional<double> common_error(const ErrorCurve& a, const ErrorCurve& b) {
    const double least = std::max(least_fitted(a), least_fitted(b));
    if (least_fitted(a) < 0 || least_fitted(b) < 0) return {};
    return least;
}

std::vector<double> log_times(const std::vector<std::vector<ErrorRun>>& repetitions, double relmse) {
    std::vector<double> times;
    for (const auto& rows : repetitions) {
        std::vector<TimedError> curve;
        for (const ErrorRun& row : rows)
            if (row.relmse > 0) curve.push_back({row.seconds, row.relmse});
        if (const auto seconds = seconds_to_error(curve, relmse)) times.push_back(std::log(*seconds));
    }
    return times;
}

std::vector<ErrorChange> changes_of(std::span<const ErrorRun> before, std::span<const ErrorRun> now) {
    std::vector<ErrorChange> changes;
    const std::vector<ErrorCurve> old_curves = curves_of(before);
    for (const ErrorCurve& curve : curves_of(now)) {
        const auto old = std::find_if(old_curves.begin(), old_curves.end(), [&](const ErrorCurve& c) {
            return c.scene == curve.scene && c.setting == curve.setting;
        });
        if (old == old_curves.end()) continue;
        const auto relmse = common_error(*old, curve);
        if (!relmse) continue;
        const Repetitions old_runs = runs_of(before, curve.scene, curve.setting),
                          runs = runs_of(now, curve.scene, curve.setting);
        const auto a = log_times(old_runs, *relmse), b = log_times(runs, *relmse);
        if (a.size() < 2 || b.size() < 2) continue;
        ErrorChange change{curve.scene, curve.setting};
        change.time_ratio = ratio_estimate(a, b);
        change.error_ratio = error_ratio(old_runs, runs);
        change.p = welch_test(a, b).p;
        changes.push_back(change);
    }
    for (ErrorChange& c : changes)
        if (c.p < sidak(changes_significance, changes.size()))
            c.verdict = c.time_ratio.value < 1 ? ErrorChange::Verdict::better : ErrorChange::Verdict::worse;
    return changes;
}

}  // namespace triad
