#include "render/schedule.h"

#include <algorithm>
#include <cmath>

namespace triad {
namespace {

/// A round at most doubles the samples: what is decided from few samples must not rule for long.
constexpr double growth = 2.0;
/// Beyond this factor a step towards the requested error goes three quarters of the way and looks again: the
/// trend is known to some percent only.
constexpr double sure_step = 1.3;
/// An estimate this close above the requested error has reached it; its own scatter is of that size.
constexpr double reached = 1.02;
/// Of the time asked for: what an even render may miss it by to end after whole samples.
constexpr double missable = 0.02;

/// Where a round ends on the way to an error: where `end` is close to a power of two samples in every bin, or
/// to one and a half times that, there, since points of a sequence lie best; clearly more than `samples`, and
/// not of the first few, where estimates are too noisy for longer steps.
double well_placed(double end, double samples, double bins) {
    const double power = bins * std::exp2(std::floor(std::log2(end / bins)));
    for (const double number : {power, 1.5 * power, 2 * power})
        if (number >= 16 * bins && number >= 1.01 * samples && number >= 0.87 * end && number <= 1.05 * end)
            return number;
    return end;
}

}  // namespace

std::string to_string(Stop stop) {
    switch (stop) {
        case Stop::samples:
            return "samples";
        case Stop::error:
            return "error";
        case Stop::time:
            return "time";
        case Stop::interrupt:
            break;
    }
    return "interrupt";
}

void Trend::add(double samples, double relmse) {
    if (!points_.empty() && points_.back().samples >= samples) points_.pop_back();
    points_.push_back({samples, relmse});
}

std::optional<double> Trend::slope() const {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, least = INFINITY, most = -INFINITY;
    for (const Point& p : points_) {
        if (p.samples < points_.back().samples / 16 || !(p.relmse > 0)) continue;
        const double u = std::log2(p.samples), v = std::log2(p.relmse);
        n += 1, x += u, y += v, xx += u * u, xy += u * v;
        least = std::min(least, u), most = std::max(most, u);
    }
    if (!(most - least >= 0.5)) return std::nullopt;
    return (n * xy - x * y) / (n * xx - x * x);
}

double Trend::samples_for(double relmse) const {
    const double steepness = std::clamp(-slope().value_or(-1.0), 0.5, 2.0);
    return samples() * std::pow(this->relmse() / relmse, 1 / steepness);
}

Schedule::Schedule(const RenderGoal& goal, unsigned bins)
    : goal_(goal), limit_(double(goal.samples.end - goal.samples.begin)), bins_(bins) {}

std::optional<double> Schedule::next_round(double samples, double seconds) {
    const auto stop = [&](Stop why) {
        stop_ = why;
        return std::nullopt;
    };
    // Adaptive rounds end near their mark, not on it; an even render that goes on may lack a few tiles' last.
    if (samples >= limit_ || (goal_.adaptive && samples > limit_ - 0.25)) return stop(Stop::samples);
    double end = limit_;
    if (goal_.adaptive || goal_.error > 0)
        end = std::min(end, samples > 0 ? growth * samples : std::max(4.0, 2 * bins_));
    if (goal_.error > 0 && !trend_.empty()) {
        if (trend_.relmse() <= goal_.error * reached) return stop(Stop::error);
        const double there = std::max(trend_.samples_for(goal_.error), 1.01 * samples);
        end = std::min(end, there > sure_step * samples ? samples + 0.75 * (there - samples) : there);
    }
    if (goal_.error > 0 && samples > 0) end = std::min(limit_, well_placed(end, samples, bins_));
    if (goal_.seconds > 0 && samples > 0) {
        if (time_is_up(samples, seconds)) return stop(Stop::time);
        end = std::min(end, samples + time_left(seconds) / pace(samples, seconds));
    }
    round_began_samples_ = samples, round_began_seconds_ = seconds;
    if (goal_.adaptive || end >= limit_) return end;
    return std::min(limit_, std::max(std::round(end / bins_) * bins_, samples + bins_));
}

double Schedule::time_left(double seconds) const {
    return goal_.seconds > 0 ? std::max(0.0, goal_.seconds - seconds) : INFINITY;
}

double Schedule::pace(double samples, double seconds) const {
    const double done = samples - round_began_samples_;
    return done > 0 ? (seconds - round_began_seconds_) / done : mean_pace(samples, seconds);
}

double Schedule::mean_pace(double samples, double seconds) const {
    return samples > first_samples_ ? seconds / (samples - first_samples_) : 0;
}

bool Schedule::may_end_within_sample(double samples, double seconds) const {
    if (!(goal_.seconds > 0)) return false;
    return goal_.adaptive || (samples > 0 && 0.5 * bins_ * pace(samples, seconds) > missable * goal_.seconds);
}

bool Schedule::time_is_up(double samples, double seconds) const {
    if (goal_.seconds <= 0 || !(samples > 0)) return false;
    const double close = may_end_within_sample(samples, seconds)
                             ? std::max(0.005 * goal_.seconds, 0.5 * least_step_)
                             : 0.5 * bins_ * pace(samples, seconds);
    return time_left(seconds) <= close;
}

double Schedule::seconds_to_error(double samples, double seconds, const Trend& trend) const {
    if (goal_.error <= 0 || trend.empty() || !(samples > first_samples_)) return -1.0;
    return std::max(0.0, trend.samples_for(goal_.error) - samples) * mean_pace(samples, seconds);
}

double Schedule::seconds_left(double samples, double seconds, const Trend& trend) const {
    if (!(samples > first_samples_)) return -1.0;
    double left = std::max(0.0, limit_ - samples) * mean_pace(samples, seconds);
    const double to_error = seconds_to_error(samples, seconds, trend);
    if (to_error >= 0) left = std::min(left, to_error);
    return std::min(left, time_left(seconds));
}

}  // namespace triad
