#include "trace/launch_times.h"

#include <algorithm>

namespace triad {
namespace {

/// Launches that differ by this factor tell what depends on the number of samples.
constexpr double apart = 2;
constexpr double most_growth = 4, most_patience = 5;
/// Of the longest path: samples beside it cost nothing at first, so that no launch is as short.
constexpr double least = 1.25;

}  // namespace

void LaunchTimes::add(double samples, double seconds) {
    seconds = std::max(seconds, 1e-6);
    floor_ = std::min(floor_, seconds);
    if (samples_ > 0 && (samples >= apart * samples_ || samples_ >= apart * samples)) {
        each_ = std::max(0.0, (seconds - seconds_) / (samples - samples_));
        floor_ = std::max(0.0, std::max(seconds, seconds_) - each_ * std::max(samples, samples_));
        is_known_ = true;
    }
    samples_ = samples, seconds_ = seconds, most_samples_ = std::max(most_samples_, samples);
}

double LaunchTimes::samples_in(double seconds) const {
    if (!(samples_ > 0)) return 0;
    const double wanted = std::max(std::clamp(2 * floor_, seconds, most_patience * seconds), least * floor_),
                 by_pace = samples_ * wanted / seconds_;
    if (!is_known_)  // far enough apart to tell
        return seconds_ < wanted ? std::max(by_pace, apart * samples_) : std::min(by_pace, samples_ / apart);
    if (seconds_ >= wanted || floor_ <= 0) return by_pace;
    const double all = most_growth * most_samples_;
    return std::max(by_pace, each_ > 0 ? std::min((wanted - floor_) / each_, all) : all);
}

}  // namespace triad
